// SPDX-License-Identifier: MIT
// Serial ports by libserialport.
#include "Live/Session/SerialLine.h"
#include "Live/Session/PseudoTerminal.h"
#include "Wire/Messages.h"
#include <libserialport.h>
#include <utility>

namespace physvib {
namespace {

constexpr int stLinkVendor = 0x0483;

struct PortDeleter {
    void operator()(sp_port* port) const { sp_free_port(port); }
};
using Port = std::unique_ptr<sp_port, PortDeleter>;

class PortLine final : public SerialLine {
public:
    explicit PortLine(Port port)
        : port_{std::move(port)} {}
    ~PortLine() override { sp_close(port_.get()); }
    int read(std::span<std::uint8_t> bytes, int milliseconds) override {
        return sp_blocking_read_next(port_.get(), bytes.data(), bytes.size(),
                                     static_cast<unsigned>(milliseconds));
    }
    bool write(std::span<const std::uint8_t> bytes) override {
        return sp_blocking_write(port_.get(), bytes.data(), bytes.size(), 50) ==
               static_cast<int>(bytes.size());
    }

private:
    Port port_;
};

std::string textOr(const char* text, const char* otherwise) { return text != nullptr ? text : otherwise; }

} // namespace

std::vector<SerialPortName> listSerialPorts() {
    std::vector<SerialPortName> names;
    sp_port** ports = nullptr;
    if (sp_list_ports(&ports) != SP_OK) return names;
    for (sp_port** port = ports; *port != nullptr; ++port) {
        int vendor = 0, product = 0;
        const bool isUsb = sp_get_port_usb_vid_pid(*port, &vendor, &product) == SP_OK;
        names.push_back({textOr(sp_get_port_name(*port), ""),
                         textOr(sp_get_port_description(*port), "serial port"),
                         isUsb && vendor == stLinkVendor});
    }
    sp_free_port_list(ports);
    return names;
}

std::unique_ptr<SerialLine> openSerialLine(const std::string& path, std::string& error) {
    if (isPseudoTerminal(path)) return openPseudoTerminal(path, error);
    sp_port* found = nullptr;
    if (sp_get_port_by_name(path.c_str(), &found) != SP_OK) {
        error = path + ": no such serial port";
        return nullptr;
    }
    Port port{found};
    const bool isReady = sp_open(found, SP_MODE_READ_WRITE) == SP_OK &&
                         sp_set_baudrate(found, wire::lineBitsPerSecond) == SP_OK &&
                         sp_set_bits(found, 8) == SP_OK && sp_set_parity(found, SP_PARITY_NONE) == SP_OK &&
                         sp_set_stopbits(found, 1) == SP_OK &&
                         sp_set_flowcontrol(found, SP_FLOWCONTROL_NONE) == SP_OK;
    if (isReady) return std::make_unique<PortLine>(std::move(port));
    char* reason = sp_last_error_message();
    error = path + ": " + textOr(reason, "cannot be opened");
    sp_free_error_message(reason);
    return nullptr;
}

} // namespace physvib
