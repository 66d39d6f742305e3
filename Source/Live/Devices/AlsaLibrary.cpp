// SPDX-License-Identifier: MIT
// Loads all of ALSA's functions, or none.
#include "Live/Devices/AlsaLibrary.h"
#include "Live/Pads/SharedLibrary.h"

namespace physvib {
namespace {

struct LoadedAlsa {
    AlsaLibrary alsa;
    bool isWhole = true;
};

void ignoreAlsaMessage(const char*, int, const char*, int, const char*, ...) {}

// What is loaded with the program comes first: a test replaces the clock of a device that way.
void* alsaFunction(void* library, const char* name) {
    void* const loadedBefore = functionIn(nullptr, name);
    return loadedBefore != nullptr ? loadedBefore : functionIn(library, name);
}

LoadedAlsa loadAlsa() {
    LoadedAlsa loaded;
    void* const library = openLibrary("libasound.so.2");
    if (library == nullptr) return {{}, false};
#define PHYSVIB_ALSA_FIND(name)                                                                              \
    loaded.alsa.name = reinterpret_cast<decltype(loaded.alsa.name)>(alsaFunction(library, "snd_" #name));    \
    loaded.isWhole = loaded.isWhole && loaded.alsa.name != nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_FIND)
#undef PHYSVIB_ALSA_FIND
    // A machine without a sound card would get sixty lines on stderr for one look at its devices.
    if (loaded.isWhole) loaded.alsa.lib_error_set_handler(ignoreAlsaMessage);
    return loaded;
}

} // namespace

const AlsaLibrary* alsaLibrary() {
    static const LoadedAlsa loaded = loadAlsa();
    return loaded.isWhole ? &loaded.alsa : nullptr;
}

} // namespace physvib
