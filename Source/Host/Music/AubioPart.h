// SPDX-License-Identifier: GPL-3.0-or-later
// What aubio makes and wants to be given back.
#pragma once
#define AUBIO_UNSTABLE 1 // its peak picker is told of only so; the version is the distribution's
#include <aubio/aubio.h>
#include <memory>

namespace physvib {

template <auto Free>
struct GivenBack {
    template <class T>
    void operator()(T* part) const {
        Free(part);
    }
};
template <class T, auto Free>
using AubioPart = std::unique_ptr<T, GivenBack<Free>>;

} // namespace physvib
