// SPDX-License-Identifier: MIT
// Bit stream reader and writer: numbers of any width, most significant bit first.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace physvib {

/// Range of a number that is stored as a share of it.
struct BitRange {
    double least = 0.0, most = 1.0;

    constexpr double at(std::uint32_t share, int bits) const {
        return least + (most - least) * share / top(bits);
    }
    /// The nearest value representable in so many bits.
    std::uint32_t share(double value, int bits) const {
        const double place = (value - least) / (most - least);
        return static_cast<std::uint32_t>(std::llround((place < 0.0   ? 0.0
                                                        : place > 1.0 ? 1.0
                                                                      : place) *
                                                       top(bits)));
    }
    static constexpr double top(int bits) { return static_cast<double>((std::uint64_t{1} << bits) - 1); }
};

/// Any thread, one at a time.
class BitWriter {
public:
    /// The lowest `bits` of `value`, at most 32.
    void number(std::uint64_t value, int bits) {
        for (int k = bits - 1; k >= 0; --k) {
            if (used_ == 0) bytes_.push_back('\0');
            if ((value >> k & 1) != 0) bytes_.back() = static_cast<char>(bytes_.back() | 0x80 >> used_);
            used_ = (used_ + 1) % 8;
        }
    }
    void share(double value, int bits, const BitRange& range) { number(range.share(value, bits), bits); }
    /// Must start at a byte boundary.
    void add(std::string_view bytes) { bytes_.append(bytes), used_ = 0; }
    /// Pads to a whole byte with zeros.
    const std::string& bytes() {
        used_ = 0;
        return bytes_;
    }

private:
    std::string bytes_;
    int used_ = 0; // used bits of the last byte
};

/// A format error with its byte in the file. Not thrown out of this module.
struct BitFault : std::runtime_error {
    BitFault(std::size_t byte, const std::string& what)
        : std::runtime_error("byte " + std::to_string(byte) + ": " + what) {}
};

/// Throws BitFault if there are fewer bits than requested. Any thread, one at a time.
class BitReader {
public:
    /// `bytes` must outlive it; they begin at byte `start` of the file.
    explicit BitReader(std::string_view bytes, std::size_t start = 0)
        : bytes_{bytes}
        , start_{start} {}

    /// At most 32 bits.
    std::uint32_t number(int bits) {
        expect(static_cast<std::size_t>(bits));
        std::uint64_t value = 0;
        for (int k = 0; k < bits; ++k, ++at_)
            value = value << 1 | (static_cast<unsigned char>(bytes_[at_ / 8]) >> (7 - at_ % 8) & 1);
        return static_cast<std::uint32_t>(value);
    }
    /// Signed, in two's complement.
    std::int32_t signedNumber(int bits) {
        const std::uint32_t value = number(bits);
        return static_cast<std::int32_t>(value << (32 - bits)) >> (32 - bits);
    }
    double share(int bits, const BitRange& range) { return range.at(number(bits), bits); }
    void skip(std::size_t bits) { expect(bits), at_ += bits; }
    std::string text(std::size_t bytes) {
        expect(8 * bytes);
        std::string found;
        for (std::size_t i = 0; i < bytes; ++i) found.push_back(static_cast<char>(number(8)));
        return found;
    }
    /// A reader of the next bytes alone; must start at a byte boundary.
    BitReader part(std::size_t bytes) {
        expect(8 * bytes);
        BitReader found{bytes_.substr(at_ / 8, bytes), start_ + at_ / 8};
        at_ += 8 * bytes;
        return found;
    }
    bool isOver() const { return at_ >= 8 * bytes_.size(); }
    [[noreturn]] void fail(const std::string& what) const { throw BitFault{start_ + at_ / 8, what}; }

private:
    void expect(std::size_t bits) const {
        if (bits > 8 * bytes_.size() - at_)
            fail("expected " + std::to_string((bits + 7) / 8) + " more bytes, found " +
                 std::to_string((8 * bytes_.size() - at_) / 8));
    }

    std::string_view bytes_;
    std::size_t start_, at_ = 0; // at_: in bits
};

} // namespace physvib
