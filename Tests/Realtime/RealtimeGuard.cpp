// SPDX-License-Identifier: GPL-3.0-or-later
// Definitions in a program go before those of its libraries; each notes the offence and calls the library's
// own.
#include "Realtime/RealtimeGuard.h"
#include <atomic>
#include <cstdarg>
#include <cstddef>
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

namespace physvib::test {

namespace {

thread_local int guards = 0;
std::array<std::atomic<std::uint64_t>, RealtimeGuard::offenceCount> offences{};

void note(RealtimeGuard::Offence offence) noexcept {
    if (guards > 0) offences[offence].fetch_add(1, std::memory_order_relaxed);
}

// The library's own function; looked up without a static guard, which is one of the offences.
template <class Function>
Function* original(std::atomic<void*>& place, const char* name) noexcept {
    void* found = place.load(std::memory_order_relaxed);
    if (found == nullptr) place = found = dlsym(RTLD_NEXT, name);
    return reinterpret_cast<Function*>(found);
}

} // namespace

RealtimeGuard::RealtimeGuard() noexcept { ++guards; }
RealtimeGuard::~RealtimeGuard() { --guards; }
std::uint64_t RealtimeGuard::count(Offence offence) noexcept { return offences[offence]; }
void RealtimeGuard::forget() noexcept {
    for (auto& count : offences) count = 0;
}
std::uint64_t RealtimeGuard::total() noexcept {
    std::uint64_t sum = 0;
    for (const auto& count : offences) sum += count;
    return sum;
}

} // namespace physvib::test

using namespace physvib::test;
using Guard = RealtimeGuard;

// glibc gives its allocator these second names, so that replacing the first needs no lookup (no allocation).
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    note(Guard::allocates);
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    note(Guard::allocates);
    return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
    note(Guard::allocates);
    return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    note(Guard::allocates);
    return __libc_memalign(alignment, size);
}
void free(void* block) {
    if (block != nullptr) note(Guard::frees);
    __libc_free(block);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::locks);
    return original<int(pthread_mutex_t*)>(place, "pthread_mutex_lock")(mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::locks);
    return original<int(pthread_mutex_t*)>(place, "pthread_mutex_trylock")(mutex);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::waits);
    return original<int(pthread_cond_t*, pthread_mutex_t*)>(place, "pthread_cond_wait")(condition, mutex);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::writes);
    return original<ssize_t(int, const void*, std::size_t)>(place, "write")(file, bytes, size);
}
long syscall(long number, ...) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::callsSystem);
    std::va_list list;
    va_start(list, number);
    std::array<long, 6> a{};
    for (auto& argument : a) argument = va_arg(list, long);
    va_end(list);
    return original<long(long, ...)>(place, "syscall")(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

int __cxa_guard_acquire(std::int64_t* guard) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::initialisesStatic);
    return original<int(std::int64_t*)>(place, "__cxa_guard_acquire")(guard);
}
[[noreturn]] void __cxa_throw(void* exception, void* type, void (*destructor)(void*)) {
    static constinit std::atomic<void*> place{nullptr};
    note(Guard::throws);
    original<void(void*, void*, void (*)(void*))>(place, "__cxa_throw")(exception, type, destructor);
    __builtin_unreachable();
}
}
