// SPDX-License-Identifier: MIT
// The I2S output. Two tiles per line: while DMA sends one, the interrupt renders the other. The DMA channels
// start each other and wrap within their tile, so the processor only writes samples.
#include "Board.h"
#include "hardware/clocks.h"
#include "hardware/dma.h"
#include "hardware/gpio.h"
#include "hardware/irq.h"
#include "hardware/pio.h"
#include "hardware/structs/systick.h"
#include "hardware/watchdog.h"

namespace physvib::pico {
namespace {

// A reset of the USB bus may block the main loop for 50 ms, in which the output is silent.
constexpr std::uint32_t maxUnattendedTiles = tilesPerSecond / 10;
constexpr std::uint32_t watchdogMs = 4;
constexpr int sides = 2;
constexpr unsigned tileBytes = tileFrames * sizeof(std::uint32_t), tileBits = 6;
static_assert(tileBytes == 1u << tileBits);

// A word is a frame of one line. Aligned, so that DMA wraps at a tile's end.
alignas(tileBytes) std::uint32_t tileWords[sides][boardLines][tileFrames];
unsigned dmaChannels[sides][boardLines];
Player<boardChannels>* activePlayer = nullptr;
Tile<boardChannels> tile;
std::uint32_t maxTileCycles = 0;

void packTile(int side) noexcept {
    for (std::size_t line = 0; line < boardLines; ++line)
        for (std::size_t k = 0; k < tileFrames; ++k)
            tileWords[side][line][k] =
                static_cast<std::uint32_t>(static_cast<std::uint16_t>(tile[k][2 * line])) << 16 |
                static_cast<std::uint16_t>(tile[k][2 * line + 1]);
}

// Interrupt of the last line's DMA: all lines have sent a tile.
void onTileSent() noexcept {
    const auto startCycles = systick_hw->cvr;
    for (int side = 0; side < sides; ++side) {
        const unsigned channel = dmaChannels[side][boardLines - 1];
        if (!dma_channel_get_irq0_status(channel)) continue;
        dma_channel_acknowledge_irq0(channel);
        activePlayer->render(tile);
        packTile(side);
    }
    gpio_put(amplifierPin, activePlayer->isAmplifierOn());
    if (activePlayer->unattendedTiles() < maxUnattendedTiles) watchdog_update();
    const std::uint32_t cycles = (startCycles - systick_hw->cvr) & 0xffffff; // it counts down
    if (cycles > maxTileCycles) maxTileCycles = cycles;
}

// I2S: the word clock changes one bit before the first bit of its channel. Side-set bit 0 is the bit clock,
// bit 1 the word clock; low is left, which a frame begins with.
unsigned loadProgram() noexcept {
    constexpr unsigned sideBits = 2;
    const auto side = [](unsigned bits) { return pio_encode_sideset(sideBits, bits); };
    static std::uint16_t code[8];
    code[0] = static_cast<std::uint16_t>(pio_encode_out(pio_pins, 1) | side(0));
    code[1] = static_cast<std::uint16_t>(pio_encode_jmp_x_dec(0) | side(1));
    code[2] = static_cast<std::uint16_t>(pio_encode_out(pio_pins, 1) | side(2));
    code[3] = static_cast<std::uint16_t>(pio_encode_set(pio_x, 14) | side(3));
    code[4] = static_cast<std::uint16_t>(pio_encode_out(pio_pins, 1) | side(2));
    code[5] = static_cast<std::uint16_t>(pio_encode_jmp_x_dec(4) | side(3));
    code[6] = static_cast<std::uint16_t>(pio_encode_out(pio_pins, 1) | side(0));
    code[7] = static_cast<std::uint16_t>(pio_encode_set(pio_x, 14) | side(1));
    pio_program program{};
    program.instructions = code;
    program.length = 8;
    program.origin = 0;
    return static_cast<unsigned>(pio_add_program(pio0, &program));
}

// Every state machine drives the same two clocks: they start together and run the same program.
void startLine(unsigned line, unsigned offset) noexcept {
    pio_gpio_init(pio0, firstDataPin + line);
    pio_sm_config c = pio_get_default_sm_config();
    sm_config_set_wrap(&c, offset, offset + 7);
    sm_config_set_sideset(&c, 2, false, false);
    sm_config_set_sideset_pins(&c, bitClockPin);
    sm_config_set_out_pins(&c, firstDataPin + line, 1);
    sm_config_set_out_shift(&c, false, true, 32);
    sm_config_set_fifo_join(&c, PIO_FIFO_JOIN_TX);
    sm_config_set_clkdiv_int_frac(&c, clockDivider, 0);
    pio_sm_init(pio0, line, offset + 7, &c);
    const std::uint32_t pins = 1u << (firstDataPin + line) | 3u << bitClockPin;
    pio_sm_set_pindirs_with_mask(pio0, line, pins, pins);
}

void startDma(unsigned line) noexcept {
    for (auto& side : dmaChannels) side[line] = static_cast<unsigned>(dma_claim_unused_channel(true));
    for (int side = 0; side < sides; ++side) {
        auto c = dma_channel_get_default_config(dmaChannels[side][line]);
        channel_config_set_transfer_data_size(&c, DMA_SIZE_32);
        channel_config_set_ring(&c, false, tileBits);
        channel_config_set_dreq(&c, pio_get_dreq(pio0, line, true));
        channel_config_set_chain_to(&c, dmaChannels[1 - side][line]);
        dma_channel_configure(dmaChannels[side][line], &c, &pio0->txf[line], tileWords[side][line],
                              tileFrames, false);
    }
    if (line == boardLines - 1)
        for (const auto& side : dmaChannels) dma_channel_set_irq0_enabled(side[line], true);
}

} // namespace

void startOutput(Player<boardChannels>& player) noexcept {
    activePlayer = &player;
    systick_hw->rvr = 0xffffff;
    systick_hw->csr = 5; // counts the processor's cycles
    pio_gpio_init(pio0, bitClockPin);
    pio_gpio_init(pio0, bitClockPin + 1);
    const unsigned offset = loadProgram();
    std::uint32_t firstChannels = 0;
    for (unsigned line = 0; line < boardLines; ++line) {
        startLine(line, offset);
        startDma(line);
        firstChannels |= 1u << dmaChannels[0][line];
    }
    irq_set_exclusive_handler(DMA_IRQ_0, onTileSent);
    irq_set_priority(DMA_IRQ_0, PICO_HIGHEST_IRQ_PRIORITY); // above USB, whose packets may be late
    irq_set_enabled(DMA_IRQ_0, true);
    dma_start_channel_mask(firstChannels);
    // A line that starts without data would stay behind the clocks.
    for (unsigned line = 0; line < boardLines; ++line)
        waitOrRestart([line] { return pio_sm_is_tx_fifo_full(pio0, line); });
    pio_enable_sm_mask_in_sync(pio0, (1u << boardLines) - 1);
    watchdog_enable(watchdogMs, true);
}

std::uint32_t worstTileCycles() noexcept { return maxTileCycles; }

} // namespace physvib::pico
