// SPDX-License-Identifier: MIT
// Array whose size is fixed when a renderer is prepared: on a computer it is allocated on the heap then, on a
// board it lies inside the object.
#pragma once
#include <array>
#include <cstddef>
#include <new>
#include <type_traits>

namespace physvib {

/// At most `Most` items. resize: message thread (M), not while rendering; all else: any thread that may use
/// the items.
template <class T, std::size_t Most, bool isOnHeap>
class Storage {
public:
    /// Provides `count` items. False, and empty, if there is no memory. The items are value-initialised if
    /// the count has changed; otherwise they keep their values.
    bool resize(std::size_t count) noexcept { return count <= Most; }

    T* data() noexcept { return items_.data(); }
    const T* data() const noexcept { return items_.data(); }
    T& operator[](std::size_t i) noexcept { return items_[i]; }
    const T& operator[](std::size_t i) const noexcept { return items_[i]; }

private:
    std::array<T, Most> items_{};
};

/// Aligned to cache lines. resize writes every item, so that the operating system has mapped all pages before
/// render.
template <class T, std::size_t Most>
class Storage<T, Most, true> {
    static_assert(std::is_trivially_destructible_v<T>);

public:
    Storage() = default;
    Storage(const Storage&) = delete;
    Storage& operator=(const Storage&) = delete;
    ~Storage() { release(); }

    bool resize(std::size_t count) noexcept {
        if (count == count_) return true;
        release();
        if (count > Most) return false;
        items_ = static_cast<T*>(::operator new(count * sizeof(T), lines, std::nothrow));
        if (items_ == nullptr) return false;
        count_ = count;
        for (std::size_t i = 0; i < count; ++i) new (items_ + i) T{};
        return true;
    }

    T* data() noexcept { return items_; }
    const T* data() const noexcept { return items_; }
    T& operator[](std::size_t i) noexcept { return items_[i]; }
    const T& operator[](std::size_t i) const noexcept { return items_[i]; }

private:
    static constexpr std::align_val_t lines{64};
    void release() noexcept {
        ::operator delete(items_, lines);
        items_ = nullptr;
        count_ = 0;
    }

    T* items_ = nullptr;
    std::size_t count_ = 0;
};

} // namespace physvib
