// The browser of the desktop, which shows the page when the studio starts.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

namespace rddlc::studio {

// Every user of the machine can read the arguments of programs, and the address is a secret. So the
// browser is given a file that only this user can read, and that leads to the address.
class DesktopBrowser {
  public:
    // Does nothing where there is no desktop, or where it cannot be told to open a page.
    explicit DesktopBrowser(const std::string& address);
    // Removes the file.
    ~DesktopBrowser();
    DesktopBrowser(const DesktopBrowser&) = delete;
    DesktopBrowser& operator=(const DesktopBrowser&) = delete;

    // Lets the system forget the program that has opened the page, once it has ended. Never waits.
    void forget_ended();

  private:
    std::filesystem::path file_;  // empty if the browser was not opened
    std::optional<pid_t> opener_;
};

}  // namespace rddlc::studio
