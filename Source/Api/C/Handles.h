// SPDX-License-Identifier: MIT
// Handles for objects that callers own. A forged or freed one is detected and never dereferenced.
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

/// Table of up to 256 objects of one kind. A handle combines the index in the table and a use count, so each
/// is unique (on 32-bit machines it repeats after 2^20 uses).
template <class Object, std::uintptr_t Kind>
class Handles {
public:
    static constexpr std::size_t capacity = 256;

    /// Keeps an object from being freed while it is in use.
    class Use {
    public:
        Use() = default;
        Use(Object& object, std::atomic<int>& users) noexcept
            : object_(&object)
            , users_(&users) {}
        Use(Use&& other) noexcept
            : object_(std::exchange(other.object_, nullptr))
            , users_(std::exchange(other.users_, nullptr)) {}
        ~Use() {
            if (users_ != nullptr) users_->fetch_sub(1);
        }
        Use& operator=(Use&&) = delete;
        explicit operator bool() const noexcept { return object_ != nullptr; }
        Object* operator->() const noexcept { return object_; }
        Object& operator*() const noexcept { return *object_; }

    private:
        Object* object_ = nullptr;
        std::atomic<int>* users_ = nullptr;
    };

    /// Adds an object and returns its handle; 0: the table is full. Any thread but R.
    std::uintptr_t add(std::unique_ptr<Object> object) noexcept {
        const std::lock_guard lock{mutex_};
        for (std::size_t i = 0; i < capacity; ++i) {
            Slot& slot = slots_[i];
            if (slot.object) continue;
            slot.object = std::move(object);
            const std::uintptr_t name = ++slot.age << 12U | i << 4U | Kind;
            slot.name.store(name);
            return name;
        }
        return 0;
    }

    /// Removes the object from the table once no thread uses it; null if there is none. Any thread but R.
    std::unique_ptr<Object> take(std::uintptr_t name) noexcept {
        const std::lock_guard lock{mutex_};
        Slot& slot = slotOf(name);
        if (name == 0 || slot.name.load() != name) return {};
        slot.name.store(0);
        while (slot.users.load() != 0) std::this_thread::yield();
        return std::move(slot.object);
    }

    /// Destroys the object. False if the handle is unknown. Any thread but R.
    bool remove(std::uintptr_t name) noexcept { return take(name) != nullptr; }

    /// The object of that handle, if it exists. Any thread, wait-free.
    Use use(std::uintptr_t name) noexcept PHYSVIB_NONBLOCKING {
        Slot& slot = slotOf(name);
        slot.users.fetch_add(1); // before the name is read; take() clears it before it reads users
        if (name != 0 && slot.name.load() == name) return {*slot.object, slot.users};
        slot.users.fetch_sub(1);
        return {};
    }

private:
    struct Slot {
        std::atomic<std::uintptr_t> name{0};
        std::atomic<int> users{0};
        std::uintptr_t age = 0;
        std::unique_ptr<Object> object;
    };
    Slot& slotOf(std::uintptr_t name) noexcept { return slots_[name >> 4U & (capacity - 1)]; }

    std::mutex mutex_;
    std::array<Slot, capacity> slots_;
};

} // namespace physvib::api
