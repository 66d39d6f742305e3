// SPDX-License-Identifier: MIT
// Controllers as Linux lists them for raw reports (/sys/class/hidraw), and writing such reports.
#pragma once
#include "Io/Result.h"
#include "Live/Pads/GamePads.h"
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// A model of controller, as it identifies itself.
struct HidModel {
    std::uint16_t vendor, product;
    PadBus bus; ///< other: any
};

struct HidPlace {
    std::filesystem::path node; ///< "/dev/hidraw3"
    std::string name;           ///< as the controller reports it
    PadBus bus = PadBus::other;
};

/// Where the system lists such devices. PHYSVIB_HIDRAW=FOLDER replaces both by FOLDER/class and FOLDER/dev,
/// for tests.
struct HidFolders {
    std::filesystem::path classes = "/sys/class/hidraw", nodes = "/dev";
    static HidFolders ofSystem();
};

/// An open controller, exclusive within the process; only for writing. One thread at a time.
class HidDevice {
public:
    /// All that are one of these models, by name of their nodes. Empty where the system has no such list. Any
    /// thread but the render thread (R), as all functions here.
    static std::vector<HidPlace> list(std::span<const HidModel> models,
                                      const HidFolders& folders = HidFolders::ofSystem());

    /// Opens the first whose name or node contains `where`, ignoring case, and that is not open in this
    /// process; anyPad: any. One line: none is there, or this user may not write to it.
    static Result<std::unique_ptr<HidDevice>> open(std::span<const HidModel> models, const std::string& where,
                                                   const HidFolders& folders = HidFolders::ofSystem());
    ~HidDevice();
    HidDevice(const HidDevice&) = delete;
    HidDevice& operator=(const HidDevice&) = delete;

    const HidPlace& place() const noexcept { return place_; }
    /// Sends one whole report, its number first; may wait for the system. False: the controller has gone.
    bool write(std::span<const std::uint8_t> report);

private:
    HidDevice(HidPlace place, std::FILE* file)
        : place_{std::move(place)}
        , file_{file} {}
    HidPlace place_;
    std::FILE* file_;
};

} // namespace physvib
