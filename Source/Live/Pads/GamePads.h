// SPDX-License-Identifier: MIT
// Game controllers by SDL: which there are, and one that is open.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// By what it is attached, as far as SDL tells.
enum class PadBus { other, usb, bluetooth };

struct GamePadInfo {
    std::string name;    ///< as it calls itself
    std::string profile; ///< the built-in one that is closest
    PadBus bus = PadBus::other;
    std::int64_t id = -1; ///< of this plugging in
    bool hasMotors = false, hasTriggers = false, hasAccelerometer = false, isDualSense = false;
};

/// "usb", "bluetooth", "other".
const char* busName(PadBus bus) noexcept;
/// What that connection takes; closer commands queue up and are felt late (Docs/pads.md).
double mostCommandsPerSecond(PadBus bus) noexcept;

/// How often it has to be told again: a command is over after this time, whatever becomes of the program that
/// sent it.
constexpr std::chrono::milliseconds padTimeOut{200};

/// One that is open, which nobody else in the process has. Its methods on any thread, one at a time.
class GamePad {
public:
    virtual ~GamePad() = default;
    virtual const GamePadInfo& info() const noexcept = 0;
    virtual bool isAttached() = 0;
    /// Both from 0 to 1, for padTimeOut at most; false: it did not take it.
    virtual bool rumble(double low, double high) = 0;
    /// Metres per second squared; false: it does not tell.
    virtual bool acceleration(std::array<float, 3>& metresPerSecond2) = 0;
    /// A report of its own kind, as DualSense.h makes one; false: it did not take it.
    virtual bool sendEffect(const void* bytes, int size) = 0;
};

/// While it lives, SDL knows of controllers; motors of those that it opened are at rest when they are closed.
class GamePads {
public:
    /// Whose driver is asked for reports that only it knows (SDL's own), instead of the system's, which stops
    /// motors when a program is killed. Counts for the first of a process.
    enum class Driver { system, sdl };
    explicit GamePads(Driver driver = Driver::system);
    ~GamePads();
    GamePads(const GamePads&) = delete;
    GamePads& operator=(const GamePads&) = delete;

    /// Empty, or why there are none to be had, in one line.
    const std::string& fault() const noexcept { return fault_; }
    /// Looks for what was plugged in and out, and ends commands that have timed out. Often.
    void update();
    /// All; what one can do is asked by opening it.
    std::vector<GamePadInfo> list();
    /// The first with motors that nobody in this process has open and whose name holds `name`, whatever the
    /// case; anyPad: any. Null: none.
    std::unique_ptr<GamePad> open(const std::string& name);

private:
    std::string fault_;
    const struct SdlLibrary* sdl_ = nullptr;
};

/// As a name: the first that is free.
inline constexpr const char* anyPad = "auto";

} // namespace physvib
