// SPDX-License-Identifier: MIT
// Whether this is compiled for the address sanitizer: GCC says it by a macro, clang as a feature.
// PHYSVIB_THREAD_SANITIZER comes from the build.
#pragma once
#if defined(__SANITIZE_ADDRESS__)
#define PHYSVIB_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PHYSVIB_ADDRESS_SANITIZER
#endif
#endif
