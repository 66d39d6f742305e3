// SPDX-License-Identifier: GPL-3.0-or-later
// The finished VST3 modules under guard, in a bare host with every bus on: JUCE's wrapper around the render call takes no
// memory either. (It does lock: a mutex that nobody else holds while a host plays.)
#include "Plugin/Formats/RawVst3.h"
#include "Realtime/RealtimeGuard.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

using namespace test;

Steinberg::tresult guarded(vst::IAudioProcessor& to, vst::ProcessData& data) {
    const RealtimeGuard guard;
    return to.process(data);
}

TEST(RealtimeModule, TakesNoMemoryWithEveryBusOn) {
    for (const std::string name : {"PhysVib", "PhysVib-Pairs"}) {
        RawVst3 host{PHYSVIB_PLUGINS "/" + name + ".vst3", name};
        ASSERT_TRUE(host.isLoaded()) << name;
        host.call = guarded;
        host.mode = vst::kRealtime; // offline the render call steps the world itself
        host.start(256);
        for (int b = 0; b < 10; ++b) { // buffers of JUCE's for notes grow once
            host.note(36);
            host.process();
        }
        RealtimeGuard::forget();
        for (int b = 0; b < 200; ++b) {
            if (b % 10 == 0) host.note(36 + b % 12);
            ASSERT_TRUE(host.process());
        }
        EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::allocates), 0u) << name;
        EXPECT_EQ(RealtimeGuard::count(RealtimeGuard::frees), 0u) << name;
        host.stop();
    }
}

} // namespace
} // namespace physvib
