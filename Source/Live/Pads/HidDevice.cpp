// SPDX-License-Identifier: MIT
// Reads the list of raw devices, and writes reports without a buffer, so that one call is one report.
#include "Live/Pads/HidDevice.h"
#include "Io/Text/CleanText.h"
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>

namespace physvib {
namespace {

std::mutex openedMutex;
std::set<std::filesystem::path> opened; // nodes opened by this process; guarded by openedMutex

/// "HID_ID=0005:0000054C:00000CE6": bus, vendor, product.
bool isOneOf(std::span<const HidModel> models, const std::string& id, PadBus& bus) {
    unsigned number = 0, vendor = 0, product = 0;
    if (std::sscanf(id.c_str(), "%x:%x:%x", &number, &vendor, &product) != 3) return false;
    bus = number == 0x03 ? PadBus::usb : number == 0x05 ? PadBus::bluetooth : PadBus::other;
    return std::ranges::any_of(models, [&](const HidModel& model) {
        return model.vendor == vendor && model.product == product &&
               (model.bus == PadBus::other || model.bus == bus);
    });
}

} // namespace

HidFolders HidFolders::ofSystem() {
    if (const char* folder = std::getenv("PHYSVIB_HIDRAW"))
        return {std::filesystem::path{folder} / "class", std::filesystem::path{folder} / "dev"};
    return {};
}

std::vector<HidPlace> HidDevice::list(std::span<const HidModel> models, const HidFolders& folders) {
    std::vector<HidPlace> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator{folders.classes, ignored}) {
        HidPlace place{folders.nodes / entry.path().filename(), {}, {}};
        std::ifstream file{entry.path() / "device" / "uevent"};
        bool isModel = false;
        for (std::string line; std::getline(file, line);) {
            const auto at = line.find('=');
            if (at == line.npos) continue;
            const std::string value = line.substr(at + 1);
            if (line.starts_with("HID_ID=")) isModel = isOneOf(models, value, place.bus);
            if (line.starts_with("HID_NAME=")) place.name = value;
        }
        if (isModel) found.push_back(std::move(place));
    }
    std::ranges::sort(found, {}, &HidPlace::node);
    return found;
}

Result<std::unique_ptr<HidDevice>> HidDevice::open(std::span<const HidModel> models, const std::string& where,
                                                   const HidFolders& folders) {
    std::string refused;
    const std::lock_guard lock{openedMutex};
    for (HidPlace& place : list(models, folders)) {
        const std::string node = place.node.string();
        if (where != anyPad && lowerCase(place.name + " " + node).find(lowerCase(where)) == std::string::npos)
            continue;
        if (opened.contains(place.node)) continue;
        if (std::FILE* const file = std::fopen(node.c_str(), "r+b")) {
            std::setvbuf(file, nullptr, _IONBF, 0);
            opened.insert(place.node);
            return std::unique_ptr<HidDevice>{new HidDevice{std::move(place), file}};
        }
        const bool isForbidden = errno == EACCES || errno == EPERM;
        refused = place.name +
                  (isForbidden ? ": this user may not write to " + node +
                                     "; install PhysVib's rule for udev and connect it again (Docs/pads.md)"
                               : ": " + node + " cannot be opened");
    }
    return Failure{refused.empty() ? "none is there" : refused};
}

HidDevice::~HidDevice() {
    std::fclose(file_);
    const std::lock_guard lock{openedMutex};
    opened.erase(place_.node);
}

bool HidDevice::write(std::span<const std::uint8_t> report) {
    std::error_code ignored;
    return std::filesystem::exists(place_.node, ignored) &&
           std::fwrite(report.data(), 1, report.size(), file_) == report.size();
}

} // namespace physvib
