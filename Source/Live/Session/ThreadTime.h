// SPDX-License-Identifier: MIT
// How long the processor has worked for a thread: waiting, and what other programs do meanwhile, does not
// count.
#pragma once

namespace physvib {

/// Of the calling thread, in seconds, since it began. Any thread but R.
double threadSeconds() noexcept;

} // namespace physvib
