// SPDX-License-Identifier: MIT
// What an older program's structures, which are shorter, may expect of their init.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <physvib/physvib.h>

namespace physvib::test {

/// Of every length that an older program may have had: filled as far as it goes, and no further. `inner`:
/// where the size of a structure at its end is, which is what fits; 0: none.
template <class Struct>
void expectBegunWithin(int (*init)(Struct*, std::size_t), std::size_t inner = 0) {
    Struct whole;
    ASSERT_EQ(init(&whole, sizeof whole), PHYSVIB_OK);
    for (std::size_t size = sizeof(std::size_t); size <= sizeof whole; ++size) {
        Struct part;
        std::memset(&part, 0xAB, sizeof part);
        ASSERT_EQ(init(&part, size), PHYSVIB_OK);
        ASSERT_EQ(part.size, size);
        part.size = sizeof whole;
        const auto *got = reinterpret_cast<const unsigned char*>(&part),
                   *full = reinterpret_cast<const unsigned char*>(&whole);
        for (std::size_t i = 0; i < size; ++i)
            ASSERT_TRUE(got[i] == full[i] || (inner > 0 && i >= inner && i < inner + sizeof size)) << size;
        ASSERT_TRUE(std::all_of(got + size, got + sizeof whole, [](unsigned char byte) {
            return byte == 0xAB;
        })) << size;
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, sizeof whole + 1})
        EXPECT_EQ(init(&whole, size), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(init(nullptr, sizeof whole), PHYSVIB_ERROR_ARGUMENT);
}

} // namespace physvib::test
