// SPDX-License-Identifier: GPL-3.0-or-later
// Owning pointer for objects of the aubio library, which must be freed by aubio's own functions.
#pragma once
#define AUBIO_UNSTABLE 1 // aubio declares its peak picker only with this; its version is the distribution's
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
