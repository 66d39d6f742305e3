// SPDX-License-Identifier: MIT
// USB: the callbacks that TinyUSB calls from pollUsb(), in the main loop; settings that survive a restart;
// and wrappers by the linker (__wrap) for requests that TinyUSB 0.18 cannot handle.
#include "Usb.h"
#include "Board.h"
#include "Console.h"
#include "Signal/Descriptors.h"
#include "Signal/FrameBuffer.h"
#include "hardware/structs/usb.h"
#include "pico/platform.h"
#include "pico/unique_id.h"
#include "tusb.h"
#include <cstdint>
#include <cstring>

#include "device/dcd.h" // behind tusb.h, which it needs

namespace physvib::pico {
namespace {

constexpr auto deviceBytes = deviceDescriptor(boardChannels, PHYSVIB_VERSION);
constexpr auto configurationBytes = configurationDescriptor(boardChannels);
constexpr auto threeByteConfiguration = configurationDescriptor(boardChannels, 3);
static_assert(configurationBytes.count == 9 + CFG_TUD_AUDIO_FUNC_1_DESC_LEN + TUD_CDC_DESC_LEN);
static_assert(packetBytes(boardChannels) == CFG_TUD_AUDIO_FUNC_1_EP_OUT_SZ_MAX);

Player<boardChannels>* player = nullptr;
AudioControls<boardChannels> controls;
Feedback usbFeedback;
MissingPackets missingPackets;
Console usbConsole;
std::uint32_t sizeErrors = 0, restarts = 0;
bool isStreaming = false;      // alternate setting 1 is selected
FeedbackFormat feedbackFormat; // also read by the interrupt of USB
char serialNumber[2 * PICO_UNIQUE_BOARD_ID_SIZE_BYTES + 1];

// Silence and volumes survive a restart by the watchdog in its scratch registers. The first of these counts
// restarts, and the last four belong to the SDK.
struct SavedSettings {
    std::array<std::uint8_t, boardChannels + 1> volumes;
    std::uint8_t isSilenced;
};
constexpr int savedWords = 3;
static_assert(sizeof(SavedSettings) <= savedWords * sizeof(std::uint32_t));

void saveSettings() noexcept {
    const SavedSettings saved{controls.toBytes(), usbConsole.isSilenced()};
    std::uint32_t words[savedWords]{};
    std::memcpy(words, &saved, sizeof saved);
    for (int k = 0; k < savedWords; ++k) watchdog_hw->scratch[k + 1] = words[k];
}
void restoreSettings() noexcept {
    std::uint32_t words[savedWords];
    for (int k = 0; k < savedWords; ++k) words[k] = watchdog_hw->scratch[k + 1];
    SavedSettings saved;
    std::memcpy(&saved, words, sizeof saved);
    controls.setFromBytes(saved.volumes);
    if (saved.isSilenced != 0) usbConsole.silence();
}

void applyVolume() noexcept {
    saveSettings();
    for (int channel = 0; channel < boardChannels; ++channel)
        player->setVolume(channel, controls.gain(channel));
}

// When a stream is closed, TinyUSB 0.18 leaves its endpoints armed, and it hangs when it arms them again: the
// board would stop as soon as a second program opened the card.
void disarmStream() noexcept {
    constexpr std::uint32_t endpointBits = USB_EP_ABORT_EP1_IN_BITS | USB_EP_ABORT_EP1_OUT_BITS;
    const bool canAbort = rp2040_chip_version() >= 2; // erratum E2: the first chips cannot
    if (canAbort) {
        hw_set_bits(&usb_hw->abort, endpointBits);
        waitOrRestart([] { return (usb_hw->abort_done & endpointBits) == endpointBits; });
    }
    usb_dpram->ep_buf_ctrl[1].in = 0;
    usb_dpram->ep_buf_ctrl[1].out = 0;
    if (!canAbort) return;
    hw_clear_bits(&usb_hw->abort_done, endpointBits);
    hw_clear_bits(&usb_hw->abort, endpointBits);
}

void answerConsole() noexcept {
    while (tud_cdc_available() > 0) {
        const auto c = static_cast<char>(tud_cdc_read_char());
        if (!usbConsole.receive(c)) continue;
        const Console::Status status{boardChannels,
                                     serialNumber,
                                     player->isPlaying(),
                                     player->ceiling(),
                                     player->underruns(),
                                     player->buffer.overruns(),
                                     missingPackets.count(),
                                     sizeErrors,
                                     restarts,
                                     player->limitedTiles(),
                                     player->buffer.level(),
                                     worstTileCycles()};
        const auto answer = usbConsole.answer(status);
        saveSettings();
        tud_cdc_write(answer.data(), static_cast<std::uint32_t>(answer.size())); // the rest is dropped
        tud_cdc_write_flush();
    }
}

} // namespace

void startUsb(Player<boardChannels>& output, std::uint32_t watchdogRestarts) noexcept {
    player = &output;
    restarts = watchdogRestarts;
    if (restarts > 0) restoreSettings();
    applyVolume();
    pico_get_unique_board_id_string(serialNumber, sizeof serialNumber);
    tusb_rhport_init_t device{};
    device.role = TUSB_ROLE_DEVICE;
    device.speed = TUSB_SPEED_FULL;
    tusb_init(0, &device);
}

void pollUsb() noexcept {
    tud_task();
    answerConsole();
    const bool isStopped = !tud_ready() || usbConsole.isSilenced();
    if (isStopped) player->requestSoftStart();
    player->setAllowed(isStreaming && !isStopped);
}

std::uint32_t errorCount() noexcept {
    return player->underruns() + player->buffer.overruns() + missingPackets.count() + sizeErrors + restarts;
}

} // namespace physvib::pico

using namespace physvib::pico;

extern "C" {

std::uint8_t const* tud_descriptor_device_cb(void) { return deviceBytes.data(); }
std::uint8_t const* tud_descriptor_configuration_cb(std::uint8_t) {
    return (feedbackFormat.isThreeBytes() ? threeByteConfiguration : configurationBytes).data.data();
}

std::uint16_t const* tud_descriptor_string_cb(std::uint8_t index, std::uint16_t) {
    static std::uint16_t text[32];
    const char* const name = boardChannels == 4 ? "PhysVib pico4" : "PhysVib pico8";
    const char* const texts[] = {"\x09\x04", "PhysVib", name, serialNumber};
    if (index >= std::size(texts)) return nullptr;
    std::size_t count = 0;
    if (index == 0)
        text[++count] = 0x0409; // English
    else
        for (const char* c = texts[index]; *c != 0 && count < std::size(text) - 1; ++c)
            text[++count] = static_cast<std::uint16_t>(*c);
    text[0] = static_cast<std::uint16_t>(TUSB_DESC_STRING << 8 | 2 * (count + 1));
    return text;
}

void tud_umount_cb(void) { isStreaming = false; }

bool tud_audio_set_itf_cb(std::uint8_t, tusb_control_request_t const* request) {
    if (TU_U16_LOW(request->wIndex) == audioStreamInterface) isStreaming = TU_U16_LOW(request->wValue) == 1;
    return true;
}
bool tud_audio_set_itf_close_EP_cb(std::uint8_t, tusb_control_request_t const*) {
    isStreaming = false;
    disarmStream();
    return true;
}

bool tud_audio_get_req_entity_cb(std::uint8_t port, tusb_control_request_t const* request) {
    auto reply = controls.get(TU_U16_HIGH(request->wIndex), request->bRequest, TU_U16_HIGH(request->wValue),
                              TU_U16_LOW(request->wValue));
    return reply.count > 0 &&
           tud_audio_buffer_and_schedule_control_xfer(port, request, reply.bytes.data(), reply.count);
}
bool tud_audio_set_req_entity_cb(std::uint8_t, tusb_control_request_t const* request, std::uint8_t* data) {
    if (!controls.set(TU_U16_HIGH(request->wIndex), request->bRequest, TU_U16_HIGH(request->wValue),
                      TU_U16_LOW(request->wValue), data, request->wLength))
        return false;
    applyVolume();
    return true;
}

bool tud_audio_feedback_format_correction_cb(std::uint8_t) { return feedbackFormat.isThreeBytes(); }

// A packet that came between a request to open the stream again and its execution is reported when the
// endpoint is armed anew; TinyUSB would arm it twice and hang. False: TinyUSB ignores the packet.
bool tud_audio_rx_done_pre_read_cb(std::uint8_t, std::uint16_t, std::uint8_t, std::uint8_t, std::uint8_t) {
    return (usb_dpram->ep_buf_ctrl[1].out & USB_BUF_CTRL_AVAIL) == 0;
}

bool tud_audio_rx_done_post_read_cb(std::uint8_t, std::uint16_t bytes, std::uint8_t, std::uint8_t,
                                    std::uint8_t) {
    constexpr std::uint16_t frameBytes = sizeof(Frame<boardChannels>);
    static Frame<boardChannels> frames[packetBytes(boardChannels) / frameBytes];
    // The FIFO is emptied: a part of a frame would shift the channels of all later ones.
    const auto readBytes = std::min<std::uint16_t>(tud_audio_read(frames, sizeof frames), bytes);
    if (tud_audio_available() > 0) tud_audio_clear_ep_out_ff();
    if (missingPackets.update(usb_hw->sof_rd, player->isPlaying())) player->buffer.markGap();
    player->buffer.write(frames, readBytes / frameBytes);
    if (readBytes % frameBytes != 0) ++sizeErrors, player->buffer.markGap();
    tud_audio_n_fb_set(0, usbFeedback.next(player->buffer.level(), FrameBuffer<boardChannels>::targetFrames,
                                           player->isPlaying()));
    return true;
}

std::uint16_t __real_tu_fifo_write_n(tu_fifo_t* fifo, void const* data, std::uint16_t bytes);

/// Returns 1 for an empty packet: TinyUSB takes 0 as an error and does not arm the endpoint again. Main loop.
std::uint16_t __wrap_tu_fifo_write_n(tu_fifo_t* fifo, void const* data, std::uint16_t bytes) {
    return bytes == 0 ? 1 : __real_tu_fifo_write_n(fifo, data, bytes);
}

void __real_dcd_event_handler(dcd_event_t const* event, bool isInterrupt);

/// Refuses standard requests of the wrong direction: if a request for a descriptor sends data, TinyUSB 0.18
/// overwrites the descriptor with it. Interrupt of USB, and main loop.
void __wrap_dcd_event_handler(dcd_event_t const* event, bool isInterrupt) {
    if (event->event_id == DCD_EVENT_BUS_RESET) feedbackFormat.reset();
    if (event->event_id != DCD_EVENT_SETUP_RECEIVED) return __real_dcd_event_handler(event, isInterrupt);
    dcd_event_t checked = *event;
    auto& request = checked.setup_received;
    if (request.bmRequestType_bit.type == TUSB_REQ_TYPE_STANDARD) {
        const bool isGetRequest =
            request.bRequest == TUSB_REQ_GET_STATUS || request.bRequest == TUSB_REQ_GET_DESCRIPTOR ||
            request.bRequest == TUSB_REQ_GET_CONFIGURATION || request.bRequest == TUSB_REQ_GET_INTERFACE;
        constexpr std::uint8_t invalidRequest = 0xff; // TinyUSB refuses it
        if (request.bRequest == TUSB_REQ_GET_DESCRIPTOR)
            feedbackFormat.onDescriptorRequest(static_cast<std::uint8_t>(request.wValue >> 8));
        const bool isIn = request.bmRequestType_bit.direction == TUSB_DIR_IN;
        if (isGetRequest ? !isIn : isIn || request.wLength > 0) request.bRequest = invalidRequest;
    }
    __real_dcd_event_handler(&checked, isInterrupt);
}

} // extern "C"
