// SPDX-License-Identifier: MIT
// SDL's functions, found when a controller is first asked for: a program that wants none neither loads SDL
// nor what it brings (fifty libraries, 18 ms of each start), and runs where there is none.
#pragma once
#include <SDL2/SDL.h>
#include <string>

namespace physvib {

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

/// Loads it at the first call; null: it is not there, or too old, and `fault` says so in one line. It stays.
/// Any thread.
const SdlLibrary* sdlLibrary(std::string& fault);

/// Of the system: the library of that name, and a function in it; null if there is none. Any thread.
void* openLibrary(const char* name);
void* functionIn(void* library, const char* name);

} // namespace physvib
