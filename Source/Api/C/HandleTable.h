// SPDX-License-Identifier: MIT
// The table behind the handles that callers of the C library hold. A forged or freed handle is detected and
// never dereferenced. "R" is the audio thread, which must not wait.
#pragma once
#include "Core/Nonblocking.h"
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace physvib::api {
constexpr std::uintptr_t rendererKind = 1, worldKind = 2, liveKind = 3, sessionKind = 4, padSetKind = 7;
/// Table of up to 256 objects. A handle combines the slot's generation, its index and `Kind`, so that each is
/// unique and fits one table only (on 32-bit machines it repeats after 2^20 uses of a slot).
template <class Object, std::uintptr_t Kind>
class HandleTable {
public:
    static constexpr std::size_t capacity = 256;

    /// Keeps an object from being freed while it is in use.
    class BorrowedObject {
    public:
        BorrowedObject() = default;
        BorrowedObject(Object& object, std::atomic<int>& userCount) noexcept
            : object_(&object)
            , userCount_(&userCount) {}
        BorrowedObject(BorrowedObject&& other) noexcept
            : object_(std::exchange(other.object_, nullptr))
            , userCount_(std::exchange(other.userCount_, nullptr)) {}
        ~BorrowedObject() {
            if (userCount_ != nullptr) userCount_->fetch_sub(1);
        }
        BorrowedObject& operator=(BorrowedObject&&) = delete;
        explicit operator bool() const noexcept { return object_ != nullptr; }
        Object* operator->() const noexcept { return object_; }
        Object& operator*() const noexcept { return *object_; }

    private:
        Object* object_ = nullptr;
        std::atomic<int>* userCount_ = nullptr;
    };

    /// Adds an object and returns its handle, or 0 if the table is full. Any thread but R.
    std::uintptr_t add(std::unique_ptr<Object> object) noexcept {
        const std::lock_guard lock{mutex_};
        for (std::size_t i = 0; i < capacity; ++i) {
            Slot& slot = slots_[i];
            if (slot.object) continue;
            slot.object = std::move(object);
            const std::uintptr_t handle = ++slot.generation << 12U | i << 4U | Kind;
            slot.handle.store(handle);
            return handle;
        }
        return 0;
    }

    /// Waits until no thread uses the object and removes it; null for an unknown handle. Any thread but R.
    std::unique_ptr<Object> extract(std::uintptr_t handle) noexcept {
        const std::lock_guard lock{mutex_};
        Slot& slot = slotOf(handle);
        if (handle == 0 || slot.handle.load() != handle) return {};
        slot.handle.store(0);
        while (slot.userCount.load() != 0) std::this_thread::yield();
        return std::move(slot.object);
    }

    /// Destroys the object. False if the handle is unknown. Any thread but R.
    bool remove(std::uintptr_t handle) noexcept { return extract(handle) != nullptr; }

    /// Returns the object, which then cannot be freed; false for an unknown handle. Any thread, wait-free.
    BorrowedObject borrow(std::uintptr_t handle) noexcept PHYSVIB_NONBLOCKING {
        Slot& slot = slotOf(handle);
        slot.userCount.fetch_add(1); // before the handle is read: extract() clears it, then reads the count
        if (handle != 0 && slot.handle.load() == handle) return {*slot.object, slot.userCount};
        slot.userCount.fetch_sub(1);
        return {};
    }

private:
    struct Slot {
        std::atomic<std::uintptr_t> handle{0};
        std::atomic<int> userCount{0};
        std::uintptr_t generation = 0;
        std::unique_ptr<Object> object;
    };
    Slot& slotOf(std::uintptr_t handle) noexcept { return slots_[handle >> 4U & (capacity - 1)]; }

    std::mutex mutex_;
    std::array<Slot, capacity> slots_;
};

} // namespace physvib::api
