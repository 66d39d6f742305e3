// SPDX-License-Identifier: MIT
// Loads all SDL functions, or none.
#include "Live/Pads/SdlLibrary.h"
#include "Live/Pads/SharedLibrary.h"
#include <initializer_list>

namespace physvib {
namespace {

struct Loaded {
    SdlLibrary sdl;
    std::string fault;
};

template <class Function>
void find(void* library, const char* name, Function& function, std::string& fault) {
    function = reinterpret_cast<Function>(functionIn(library, name));
    if (function == nullptr) fault = std::string{"SDL 2 is too old for game controllers: it has no "} + name;
}

Loaded load() {
    Loaded loaded;
    void* library = nullptr;
    for (const char* name : {"libSDL2-2.0.so.0", "SDL2.dll", "libSDL2-2.0.0.dylib"})
        if (library == nullptr) library = openLibrary(name);
    if (library == nullptr) {
        loaded.fault = "game controllers need SDL 2 (Debian: libsdl2-2.0-0)";
        return loaded;
    }
#define PHYSVIB_SDL_FIND(name) find(library, "SDL_" #name, loaded.sdl.name, loaded.fault);
    PHYSVIB_SDL_FUNCTIONS(PHYSVIB_SDL_FIND)
#undef PHYSVIB_SDL_FIND
    return loaded;
}

} // namespace

const SdlLibrary* sdlLibrary(std::string& fault) {
    static const Loaded loaded = load();
    fault = loaded.fault;
    return fault.empty() ? &loaded.sdl : nullptr;
}

} // namespace physvib
