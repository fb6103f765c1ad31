// The browser of the desktop is a script here, which keeps what it was given.
#include "studio/desktop_browser.hpp"

#include "lsp/positions.hpp"
#include "support/files.hpp"
#include "test_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

namespace rddlc::studio {
namespace {

// A variable of the environment, as it was before when this ends.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = std::getenv(name)) before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(DesktopBrowserTest, AddressIsInNoArgument) {
    const TestFolder folder;
    const std::filesystem::path given = folder.path / "given";
    const std::string script = folder.write(
        "xdg-open", "#!/bin/sh\nprintf %s \"$*\" > '" + given.string() + ".part'\n/bin/mv '" +
                        given.string() + ".part' '" + given.string() + "'\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const Variable path("PATH", folder.path.string()), display("DISPLAY", ":0"),
        runtime("XDG_RUNTIME_DIR", folder.path.string());
    const std::string address = "http://127.0.0.1:7334/#secret";
    std::filesystem::path page;
    {
        DesktopBrowser browser(address);
        for (int tries = 0; tries < 1000 && !std::filesystem::exists(given); ++tries)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        page = lsp::path_of(read_file(given)).value();
        EXPECT_EQ(page.parent_path(), folder.path);
        EXPECT_NE(read_file(page).find("url=" + address), std::string::npos);
        struct stat facts {};
        ASSERT_EQ(stat(page.c_str(), &facts), 0);
        EXPECT_EQ(facts.st_mode & 0777, 0600u);
        browser.forget_ended();
    }
    EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace rddlc::studio
