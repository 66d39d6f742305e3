// SPDX-License-Identifier: MIT
// Loads SDL at run time, when a controller is first needed. Programs without controllers neither load SDL and
// its fifty libraries (18 ms per start) nor need it installed.
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

/// Loads SDL at the first call, for the life of the process. Null if SDL is missing or too old; `fault` then
/// has one line. Any thread.
const SdlLibrary* sdlLibrary(std::string& fault);

} // namespace physvib
