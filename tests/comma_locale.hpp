// A locale where 1234.5 is written 1.234,5, as applications set it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <string>

namespace rddl {

// 1.234,5
struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

// The locale of C and that of C++ are two.
class CommaLocale : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::filesystem::temp_directory_path() / ("locale-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        const std::string make =
            "localedef -i de_DE -f UTF-8 '" + folder_.string() + "/de_DE.UTF-8' > /dev/null 2>&1";
        static_cast<void>(std::system(make.c_str()));
        ::setenv("LOCPATH", folder_.c_str(), 1);
    }
    static void TearDownTestSuite() {
        ::unsetenv("LOCPATH");
        std::filesystem::remove_all(folder_);
    }
    void SetUp() override {
        std::locale::global(std::locale(std::locale::classic(), new Commas));
        has_c_locale_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    }
    void TearDown() override { end(); }
    static void end() {
        std::locale::global(std::locale::classic());
        std::setlocale(LC_ALL, "C");
    }

    // A machine without the sources of locales has that of C++ alone.
    bool has_c_locale() const { return has_c_locale_; }

  private:
    static inline std::filesystem::path folder_;
    bool has_c_locale_ = false;
};

}  // namespace rddl
