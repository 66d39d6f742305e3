// SPDX-License-Identifier: MIT
// Lists and opens game controllers through SDL, which is loaded at run time.
#pragma once
#include <SDL2/SDL.h>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace physvib {
/// Connection of a controller, as far as SDL reports it.
enum class PadBus { other, usb, bluetooth };

struct GamePadInfo {
    std::string name;    ///< as the controller reports it
    std::string profile; ///< the closest built-in profile
    PadBus bus = PadBus::other;
    std::int64_t id = -1; ///< SDL's instance id; new for each connection
    bool hasMotors = false, hasTriggers = false, hasAccelerometer = false, isDualSense = false;
};

/// "usb", "bluetooth", "other".
const char* busName(PadBus bus) noexcept;
/// Maximum rate for that connection; faster commands queue up and are felt late (Docs/pads.md).
double maxCommandsPerSecond(PadBus bus) noexcept;

/// A command ends after this time and must be repeated before, so motors stop even if the program is killed.
constexpr std::chrono::milliseconds padTimeOut{200};

/// An open controller, exclusive within the process. Methods may be called on any thread, one at a time.
class GamePad {
public:
    virtual ~GamePad() = default;
    virtual const GamePadInfo& info() const noexcept = 0;
    virtual bool isAttached() = 0;
    /// Sets the heavy (`low`) and the light motor, 0 to 1, for at most padTimeOut; false: it failed.
    virtual bool rumble(double low, double high) = 0;
    /// Reads the acceleration in m/s^2; false: not available.
    virtual bool acceleration(std::array<float, 3>& metresPerSecond2) = 0;
    /// Sends a device-specific report, as made by PadReports.h; false: the controller refused.
    virtual bool sendEffect(const void* bytes, int size) = 0;
};

/// Keeps SDL's controller support running while it exists. Closing a controller stops its motors.
class GamePads {
public:
    /// Driver that handles controllers. SDL's own can send device-specific reports; the system's stops motors
    /// when a program is killed. The first GamePads of a process decides.
    enum class Driver { system, sdl };
    explicit GamePads(Driver driver = Driver::system);
    ~GamePads();
    GamePads(const GamePads&) = delete;
    GamePads& operator=(const GamePads&) = delete;

    /// Empty, or one line why controllers are not available.
    const std::string& error() const noexcept { return error_; }
    /// Detects connected and disconnected controllers, and ends commands that have timed out. Call often.
    void update();
    /// All controllers; capabilities are known only once one is open.
    std::vector<GamePadInfo> list();
    /// Opens the first controller that has motors, is not open in this process, and whose name contains
    /// `name`, ignoring case; anyPad: any. Null: none.
    std::unique_ptr<GamePad> open(const std::string& name);

private:
    std::string error_;
    const struct SdlLibrary* sdl_ = nullptr;
};

/// The name that stands for the first free controller.
inline constexpr const char* anyPad = "auto";

// Loads SDL at run time, when a controller is first needed. Programs without controllers neither load SDL and
// its fifty libraries (18 ms per start) nor need it installed.

#define PHYSVIB_SDL_FUNCTIONS(use)                                                                           \
    use(SetMainReady) use(SetHintWithPriority) use(InitSubSystem) use(QuitSubSystem) use(WasInit)            \
        use(GetError) use(GetVersion) use(JoystickUpdate) use(JoystickEventState) use(LockJoysticks)         \
            use(UnlockJoysticks) use(NumJoysticks) use(JoystickNameForIndex)                                 \
                use(JoystickGetDeviceInstanceID) use(JoystickGetDeviceGUID) use(JoystickOpen)                \
                    use(JoystickClose) use(JoystickGetAttached) use(JoystickHasRumble)                       \
                        use(JoystickHasRumbleTriggers) use(JoystickRumble) use(IsGameController)             \
                            use(GameControllerTypeForIndex) use(GameControllerEventState)                    \
                                use(GameControllerOpen) use(GameControllerClose)                             \
                                    use(GameControllerHasSensor) use(GameControllerSetSensorEnabled)         \
                                        use(GameControllerGetSensorData) use(GameControllerSendEffect)

struct SdlLibrary {
#define PHYSVIB_SDL_MEMBER(name) decltype(&::SDL_##name) name = nullptr;
    PHYSVIB_SDL_FUNCTIONS(PHYSVIB_SDL_MEMBER)
#undef PHYSVIB_SDL_MEMBER
};

/// Loads SDL at the first call, for the life of the process. Null if SDL is missing or too old; `error` then
/// has one line. Any thread.
const SdlLibrary* sdlLibrary(std::string& error);

} // namespace physvib
