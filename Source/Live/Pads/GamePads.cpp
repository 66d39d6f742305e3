// SPDX-License-Identifier: MIT
// Game controllers through SDL's joystick API, because controllers without a mapping have motors too.
#include "Live/Pads/GamePads.h"
#include "Io/Text/CleanText.h"
#include "Live/Session/System.h"
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <mutex>
#include <set>

namespace physvib {
namespace {

constexpr std::uint32_t subsystems = SDL_INIT_JOYSTICK | SDL_INIT_GAMECONTROLLER;

std::mutex openPadsMutex;
std::set<std::int64_t> openPads; // ids of controllers; guarded by openPadsMutex

/// SDL updates its list of devices under this lock, so an index stays valid while it is held.
class JoystickLock {
public:
    explicit JoystickLock(const SdlLibrary& sdl)
        : sdl_{sdl} {
        sdl_.LockJoysticks();
    }
    ~JoystickLock() { sdl_.UnlockJoysticks(); }
    JoystickLock(const JoystickLock&) = delete;
    JoystickLock& operator=(const JoystickLock&) = delete;

private:
    const SdlLibrary& sdl_;
};

// The first two bytes of a GUID are the bus number, as on Linux.
PadBus readBus(const SDL_JoystickGUID& guid) {
    const int bus = guid.data[0] | guid.data[1] << 8;
    return bus == 0x03 ? PadBus::usb : bus == 0x05 ? PadBus::bluetooth : PadBus::other;
}

const char* chooseProfile(SDL_GameControllerType type) {
    switch (type) {
    case SDL_CONTROLLER_TYPE_XBOX360:
    case SDL_CONTROLLER_TYPE_XBOXONE: return "pad-xbox";
    case SDL_CONTROLLER_TYPE_PS3:
    case SDL_CONTROLLER_TYPE_PS4:
    case SDL_CONTROLLER_TYPE_PS5: return "pad-dualshock";
    default: return "pad-generic";
    }
}

GamePadInfo readInfo(const SdlLibrary& sdl, int index) {
    GamePadInfo info;
    const char* name = sdl.JoystickNameForIndex(index);
    info.name = name ? name : "a controller without a name";
    info.id = sdl.JoystickGetDeviceInstanceID(index);
    info.bus = readBus(sdl.JoystickGetDeviceGUID(index));
    const auto type =
        sdl.IsGameController(index) ? sdl.GameControllerTypeForIndex(index) : SDL_CONTROLLER_TYPE_UNKNOWN;
    info.profile = chooseProfile(type);
    info.isDualSense = type == SDL_CONTROLLER_TYPE_PS5;
    return info;
}

class SdlPad final : public GamePad {
public:
    SdlPad(const SdlLibrary& sdl, int index)
        : sdl_{sdl}
        , info_{readInfo(sdl, index)}
        , joystick_{sdl.JoystickOpen(index)}
        , controller_{sdl.IsGameController(index) ? sdl.GameControllerOpen(index) : nullptr} {
        if (joystick_ == nullptr) return;
        info_.hasMotors = sdl.JoystickHasRumble(joystick_);
        info_.hasTriggers = sdl.JoystickHasRumbleTriggers(joystick_);
        info_.hasAccelerometer = controller_ && sdl.GameControllerHasSensor(controller_, SDL_SENSOR_ACCEL);
    }
    ~SdlPad() override {
        // a pad that was only inspected may be playing for another program
        if (hasRumbled_) sdl_.JoystickRumble(joystick_, 0, 0, 0);
        if (controller_) sdl_.GameControllerClose(controller_);
        if (joystick_) sdl_.JoystickClose(joystick_);
        const std::lock_guard lock{openPadsMutex};
        openPads.erase(info_.id);
    }

    bool isOpen() const { return joystick_ != nullptr; }
    const GamePadInfo& info() const noexcept override { return info_; }
    bool isAttached() override { return sdl_.JoystickGetAttached(joystick_); }
    bool rumble(double low, double high) override {
        hasRumbled_ = true;
        const auto word = [](double command) {
            return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(command, 0.0, 1.0)));
        };
        const auto ms = low > 0.0 || high > 0.0 ? static_cast<std::uint32_t>(padTimeOut.count()) : 0u;
        return sdl_.JoystickRumble(joystick_, word(low), word(high), ms) == 0;
    }
    bool acceleration(std::array<float, 3>& metresPerSecond2) override {
        if (!info_.hasAccelerometer) return false;
        if (!isSensing_)
            isSensing_ = sdl_.GameControllerSetSensorEnabled(controller_, SDL_SENSOR_ACCEL, SDL_TRUE) == 0;
        return isSensing_ && sdl_.GameControllerGetSensorData(controller_, SDL_SENSOR_ACCEL,
                                                              metresPerSecond2.data(), 3) == 0;
    }
    bool sendEffect(const void* bytes, int size) override {
        return controller_ && sdl_.GameControllerSendEffect(controller_, bytes, size) == 0;
    }

private:
    const SdlLibrary& sdl_;
    GamePadInfo info_;
    SDL_Joystick* joystick_;
    SDL_GameController* controller_;
    bool isSensing_ = false, hasRumbled_ = false;
};

bool matchesName(const GamePadInfo& info, const std::string& name) {
    return name == anyPad || lowerCase(info.name).find(lowerCase(name)) != std::string::npos;
}

bool claimPad(std::int64_t id) {
    const std::lock_guard lock{openPadsMutex};
    return openPads.insert(id).second;
}

// Sets nothing if the host uses SDL itself and has its own hints.
void setHints(const SdlLibrary& sdl, GamePads::Driver driver) {
    if (sdl.WasInit(SDL_INIT_JOYSTICK) != 0) return;
    const auto hint = [&](const char* name, const char* value) {
        sdl.SetHintWithPriority(name, value, SDL_HINT_DEFAULT);
    };
    sdl.SetMainReady();
    hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    hint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
#ifdef __linux__
    // the kernel's driver stops the motors of a killed program
    hint(SDL_HINT_JOYSTICK_HIDAPI, driver == GamePads::Driver::sdl ? "1" : "0");
#else
    static_cast<void>(driver);
#endif
}

struct LoadedSdl {
    SdlLibrary sdl;
    std::string error;
};

template <class Function>
void findSdlFunction(void* library, const char* name, Function& function, std::string& error) {
    function = reinterpret_cast<Function>(findFunction(library, name));
    if (function == nullptr) error = std::string{"SDL 2 is too old for game controllers: it has no "} + name;
}

LoadedSdl loadSdl() {
    LoadedSdl loaded;
    void* library = nullptr;
    for (const char* name : {"libSDL2-2.0.so.0", "SDL2.dll", "libSDL2-2.0.0.dylib"})
        if (library == nullptr) library = openLibrary(name);
    if (library == nullptr) {
        loaded.error = "game controllers need SDL 2 (Debian: libsdl2-2.0-0)";
        return loaded;
    }
#define PHYSVIB_SDL_FIND(name) findSdlFunction(library, "SDL_" #name, loaded.sdl.name, loaded.error);
    PHYSVIB_SDL_FUNCTIONS(PHYSVIB_SDL_FIND)
#undef PHYSVIB_SDL_FIND
    return loaded;
}

} // namespace

const char* busName(PadBus bus) noexcept {
    return bus == PadBus::usb ? "usb" : bus == PadBus::bluetooth ? "bluetooth" : "other";
}
double maxCommandsPerSecond(PadBus bus) noexcept { return bus == PadBus::usb ? 125.0 : 30.0; }

GamePads::GamePads(Driver driver)
    : sdl_{sdlLibrary(error_)} {
    if (sdl_ == nullptr) return;
    setHints(*sdl_, driver);
    const bool isFirst = sdl_->WasInit(SDL_INIT_JOYSTICK) == 0;
    if (sdl_->InitSubSystem(subsystems) != 0) {
        error_ = std::string{"game controllers: "} + sdl_->GetError();
        sdl_ = nullptr;
    } else if (isFirst) { // this process does not read SDL events
        sdl_->JoystickEventState(SDL_IGNORE);
        sdl_->GameControllerEventState(SDL_IGNORE);
    }
}

GamePads::~GamePads() {
    if (sdl_) sdl_->QuitSubSystem(subsystems);
}

void GamePads::update() {
    if (sdl_) sdl_->JoystickUpdate();
}

std::vector<GamePadInfo> GamePads::list() {
    std::vector<GamePadInfo> found;
    if (sdl_ == nullptr) return found;
    const JoystickLock lock{*sdl_};
    for (int i = 0; i < sdl_->NumJoysticks(); ++i) {
        const GamePadInfo info = readInfo(*sdl_, i);
        found.push_back(claimPad(info.id) ? SdlPad{*sdl_, i}.info() : info);
    }
    return found;
}

std::unique_ptr<GamePad> GamePads::open(const std::string& name) {
    if (sdl_ == nullptr) return {};
    const JoystickLock lock{*sdl_};
    for (int i = 0; i < sdl_->NumJoysticks(); ++i) {
        const GamePadInfo info = readInfo(*sdl_, i);
        if (!matchesName(info, name) || !claimPad(info.id)) continue;
        auto pad = std::make_unique<SdlPad>(*sdl_, i);
        if (pad->isOpen() && pad->info().hasMotors) return pad;
    }
    return {};
}

const SdlLibrary* sdlLibrary(std::string& error) {
    static const LoadedSdl loaded = loadSdl();
    error = loaded.error;
    return error.empty() ? &loaded.sdl : nullptr;
}

} // namespace physvib
