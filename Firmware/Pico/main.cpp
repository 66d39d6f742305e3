// SPDX-License-Identifier: MIT
// Main program of the Pico as a USB sound card for actuators.
// The interrupt of the output renders tiles and comes first; USB is served by the main loop. If the main loop
// hangs, the output ramps to silence within 4 ms, and the chip restarts after 100 ms. If the interrupt hangs,
// the watchdog restarts the chip within 4 ms: its pins become inputs, and the amplifiers' shut-down line
// falls.
#include "Board.h"
#include "Signal/Indicator.h"
#include "Usb.h"
#include "hardware/clocks.h"
#include "hardware/gpio.h"
#include "hardware/sync.h"
#include "hardware/watchdog.h"

namespace physvib::pico {
namespace {

Player<boardChannels> player;
Indicator indicator;
CeilingJumper ceiling;

void startPins() noexcept {
    for (const unsigned pin : {ledPin, amplifierPin}) {
        gpio_init(pin);
        gpio_set_dir(pin, true);
        gpio_put(pin, false);
    }
    gpio_init(ceilingPin);
    gpio_pull_up(ceilingPin);
}

// Counts restarts by the watchdog in a scratch register that such a restart keeps.
std::uint32_t countRestarts() noexcept {
    auto& count = watchdog_hw->scratch[0];
    count = watchdog_enable_caused_reboot() ? count + 1 : 0;
    return count;
}

[[noreturn]] void run() noexcept {
    startPins();
    set_sys_clock_pll(768'000'000, 5, 2);
    startUsb(player, countRestarts());
    startOutput(player);
    for (;;) {
        pollUsb();
        const auto tiles = player.tiles();
        player.setLowCeiling(!ceiling.update(tiles, !gpio_get(ceilingPin)));
        const auto light = indicator.update(tiles, player.isPlaying(), player.limitedTiles(), errorCount());
        gpio_put(ledPin, Indicator::isOn(light, tiles));
        __wfi(); // until the next tile or packet
    }
}

} // namespace
} // namespace physvib::pico

int main() { physvib::pico::run(); }
