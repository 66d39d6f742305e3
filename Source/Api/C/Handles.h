// SPDX-License-Identifier: MIT
// Handles for objects that callers own. A forged or freed one is detected and never dereferenced.
#pragma once
#include "Api/C/Calls.h"
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
template <class Object, class Name, std::uintptr_t Kind>
class Handles {
public:
    static constexpr std::size_t capacity = 256;

    /// The only table; never destroyed: threads may outlive main.
    static Handles& all() {
        static auto* const one = new Handles;
        return *one;
    }

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

    /// Adds an object and writes its handle to `to`; returns PHYSVIB_OK, or an error with the text `full`.
    /// Any thread but the audio thread.
    int add(std::unique_ptr<Object> object, Name* to, std::string_view full) noexcept {
        const std::lock_guard lock{mutex_};
        const auto free = std::ranges::find_if(slots_, [](const Slot& slot) { return !slot.object; });
        if (free == slots_.end()) return fail(PHYSVIB_ERROR_FULL, full);
        free->object = std::move(object);
        const auto index = static_cast<std::uintptr_t>(free - slots_.begin());
        const std::uintptr_t name = ++free->age << 12U | index << 4U | Kind;
        free->name.store(name);
        *to = reinterpret_cast<Name>(name);
        return PHYSVIB_OK;
    }

    /// Waits until no thread uses the object and hands it over; null for an unknown handle. Not the audio
    /// thread.
    std::unique_ptr<Object> take(Name handle) noexcept {
        const std::lock_guard lock{mutex_};
        const auto name = reinterpret_cast<std::uintptr_t>(handle);
        Slot& slot = slotOf(name);
        if (name == 0 || slot.name.load() != name) return {};
        slot.name.store(0);
        while (slot.users.load() != 0) std::this_thread::yield();
        return std::move(slot.object);
    }

    /// Destroys the object. Returns PHYSVIB_OK, or the error of an unknown handle. Not the audio thread.
    int remove(Name handle) noexcept { return take(handle) != nullptr ? PHYSVIB_OK : unknownHandle(); }

    /// The object of that handle, false if there is none; it is not freed meanwhile. Any thread, wait-free.
    Use use(Name handle) noexcept PHYSVIB_NONBLOCKING {
        const auto name = reinterpret_cast<std::uintptr_t>(handle);
        Slot& slot = slotOf(name);
        slot.users.fetch_add(1); // before the name is read; take() clears it before it reads users
        if (name != 0 && slot.name.load() == name) return {*slot.object, slot.users};
        slot.users.fetch_sub(1);
        return {};
    }

    /// Returns the result of `call(object)`, as guarded() does, or the error of an unknown handle.
    template <class Call>
    auto in(Name handle, Call call) noexcept -> decltype(call(std::declval<Object&>())) {
        return guarded([&]() -> decltype(call(std::declval<Object&>())) {
            const Use object = use(handle);
            if (!object) return unknownHandle();
            return call(*object);
        });
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
