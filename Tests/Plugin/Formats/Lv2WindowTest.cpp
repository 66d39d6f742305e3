// SPDX-License-Identifier: GPL-3.0-or-later
// An open LV2 window writes the ports of parameters that something else has moved. Needs a display.
#include "Plugin/Formats/RawLv2.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <lv2/instance-access/instance-access.h>
#include <lv2/ui/ui.h>
#include <thread>
// X11's macros come last
#include "Plugin/Formats/DisplayNames.h"

namespace physvib::lv2_window_test {

using namespace test;

/// The window as a host opens it: its parent, its idle calls, and the ports that it writes.
class RawLv2Window {
public:
    RawLv2Window(RawLv2& host, Display* display)
        : host_{host}
        , parent_{XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 600, 400, 0, 0, 0)} {
        XSync(display, 0); // the window uses a connection of its own
        using Entry = const LV2UI_Descriptor* (*)(std::uint32_t);
        descriptor_ = reinterpret_cast<Entry>(host.symbol("lv2ui_descriptor"))(0);
        const LV2_Feature map{LV2_URID__map, &host.map()}, access{LV2_INSTANCE_ACCESS_URI, host.handle()};
        const LV2_Feature parent{LV2_UI__parent, reinterpret_cast<void*>(parent_)};
        const LV2_Feature* const features[]{&map, &access, &parent, nullptr};
        LV2UI_Widget widget = nullptr;
        const char* const bundle = PHYSVIB_PLUGINS "/PhysVib.lv2/";
        handle_ = descriptor_->instantiate(descriptor_, "urn:physvib:plugin", bundle, take, this, &widget,
                                           features);
    }
    ~RawLv2Window() { descriptor_->cleanup(handle_); }
    RawLv2Window(const RawLv2Window&) = delete;
    RawLv2Window& operator=(const RawLv2Window&) = delete;

    /// So many idle calls, with a block before each.
    void idle(int times) {
        const auto* const idle = descriptor_->extension_data(LV2_UI__idleInterface);
        for (int n = 0; n < times; ++n) {
            host_.run(256);
            static_cast<const LV2UI_Idle_Interface*>(idle)->idle(handle_);
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
    }
    std::vector<std::pair<std::size_t, float>> written;

private:
    static void take(LV2UI_Controller self, std::uint32_t port, std::uint32_t size, std::uint32_t protocol,
                     const void* value) {
        ASSERT_TRUE(size == sizeof(float) && protocol == 0);
        auto& window = *static_cast<RawLv2Window*>(self);
        const auto parameter = port - RawLv2::firstControl;
        std::memcpy(&window.host_.controls.at(parameter), value, size);
        window.written.emplace_back(parameter, window.host_.controls[parameter]);
    }
    RawLv2& host_;
    Window parent_;
    const LV2UI_Descriptor* descriptor_ = nullptr;
    LV2UI_Handle handle_ = nullptr;
};

constexpr auto level = static_cast<std::size_t>(Parameter::level);
constexpr auto gravity = static_cast<std::size_t>(Parameter::gravity);

TEST(Lv2Window, WritesThePortOfAParameterThatSomethingElseMoved) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "there is no display";
    Display* const display = openDisplayWithNames();
    {
        RawLv2 host{256, 256};
        ASSERT_TRUE(host.isLoaded());
        host.activate();
        RawLv2Window window{host, display};
        window.idle(5);
        window.written.clear();         // what the preset set
        host.controls[gravity] *= 0.5f; // the host's own move is no news
        window.idle(5);
        EXPECT_TRUE(window.written.empty());
        host.points.push_back({0, "level", -20.0f});
        window.idle(5);
        ASSERT_EQ(window.written.size(), 1u) << "once";
        EXPECT_EQ(window.written[0].first, level);
        EXPECT_NEAR(window.written[0].second, -20.0f, 1e-4f);
        host.deactivate();
    }
    XCloseDisplay(display);
}

} // namespace physvib::lv2_window_test
