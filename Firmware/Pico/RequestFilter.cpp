// SPDX-License-Identifier: MIT
// What TinyUSB 0.18 would not survive, put right before it sees it. The linker puts these functions before
// TinyUSB's (--wrap).
//
// Refuses standard requests whose direction contradicts them, before TinyUSB 0.18 sees them: asked for a
// descriptor by a request that sends data, it writes that data over the descriptor.
#include "tusb.h" // first: dcd.h needs it

#include "Usb.h"
#include "device/dcd.h"
#include <cstdint>

extern "C" {

std::uint16_t __real_tu_fifo_write_n(tu_fifo_t* fifo, void const* data, std::uint16_t bytes);

/// A packet of no bytes is no failure: TinyUSB takes the 0 for one, and never arms the stream's endpoint
/// again. Main loop.
std::uint16_t __wrap_tu_fifo_write_n(tu_fifo_t* fifo, void const* data, std::uint16_t bytes) {
    return bytes == 0 ? 1 : __real_tu_fifo_write_n(fifo, data, bytes);
}

void __real_dcd_event_handler(dcd_event_t const* event, bool isInterrupt);

/// Interrupt of USB, and main loop.
void __wrap_dcd_event_handler(dcd_event_t const* event, bool isInterrupt) {
    if (event->event_id == DCD_EVENT_BUS_RESET) physvib::pico::feedbackForm.reset();
    if (event->event_id != DCD_EVENT_SETUP_RECEIVED) return __real_dcd_event_handler(event, isInterrupt);
    dcd_event_t checked = *event;
    auto& request = checked.setup_received;
    if (request.bmRequestType_bit.type == TUSB_REQ_TYPE_STANDARD) {
        const bool answers =
            request.bRequest == TUSB_REQ_GET_STATUS || request.bRequest == TUSB_REQ_GET_DESCRIPTOR ||
            request.bRequest == TUSB_REQ_GET_CONFIGURATION || request.bRequest == TUSB_REQ_GET_INTERFACE;
        constexpr std::uint8_t unknown = 0xff; // which TinyUSB refuses
        if (request.bRequest == TUSB_REQ_GET_DESCRIPTOR)
            physvib::pico::feedbackForm.asks(static_cast<std::uint8_t>(request.wValue >> 8));
        const bool isIn = request.bmRequestType_bit.direction == TUSB_DIR_IN;
        if (answers ? !isIn : isIn || request.wLength > 0) request.bRequest = unknown;
    }
    __real_dcd_event_handler(&checked, isInterrupt);
}

} // extern "C"
