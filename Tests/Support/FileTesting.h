// SPDX-License-Identifier: MIT
// What the tests of Files share: seeded numbers, mutated texts, files and a folder of their own, a locale
// with a comma.
#pragma once
#include "Io/Disk/ReadFile.h"
#include "Support/Mutations.h"
#include <bit>
#include <clocale>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <locale>
#include <random>
#include <string>
#include <string_view>
#include <unistd.h>

namespace physvib {

/// Any finite double: every bit pattern, so denormals and huge numbers too.
inline double anyDouble(std::mt19937& random) {
    for (;;) {
        const std::uint64_t high = random();
        const double number = std::bit_cast<double>((high << 32) | random());
        if (std::isfinite(number)) return number;
    }
}

inline void put(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}
inline std::string contentOf(const std::filesystem::path& path) { return readFile(path, 1'000'000).value; }

/// A fresh empty folder for one test, gone afterwards.
class FolderTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
        folder =
            std::filesystem::temp_directory_path() / (std::string("physvib-") + test->test_suite_name() +
                                                      "-" + test->name() + "-" + std::to_string(getpid()));
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::size_t filesInFolder() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                      std::filesystem::directory_iterator()));
    }

    std::filesystem::path folder;
};

/// While it lives, numbers have a decimal comma: for C++ streams always, for C functions if the machine has
/// such a locale (hasCLocale).
class CommaLocale {
public:
    CommaLocale()
        : before_(std::locale::global(std::locale(std::locale::classic(), new Punctuation))) {
        for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "es_ES.UTF-8", "it_IT.UTF-8"})
            hasCLocale = hasCLocale || std::setlocale(LC_ALL, name) != nullptr;
    }
    ~CommaLocale() {
        std::locale::global(before_);
        std::setlocale(LC_ALL, "C");
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

    bool hasCLocale = false;

private:
    struct Punctuation : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    std::locale before_;
};

} // namespace physvib
