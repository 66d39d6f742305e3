// SPDX-License-Identifier: MIT
// Processor time of the calling thread, which excludes waiting and other programs.
#pragma once

namespace physvib {

/// In seconds, since the thread began. Any thread but the render thread (R).
double threadSeconds() noexcept;

} // namespace physvib
