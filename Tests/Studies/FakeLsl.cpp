// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for liblsl: what it is asked to push becomes lines of the file that PHYSVIB_FAKE_LSL names:
// milliseconds from now, a tab, the text.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

void note(const char* words, double milliseconds) {
    if (const char* path = std::getenv("PHYSVIB_FAKE_LSL"))
        if (std::FILE* file = std::fopen(path, "a")) {
            std::fprintf(file, "%.1f\t%s\n", milliseconds, words);
            std::fclose(file);
        }
}
int anything = 0;

} // namespace

extern "C" {
void* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels, double rateHz,
                            std::int32_t format, const char*) {
    note(name, 0.0);
    note(type, 0.0);
    return channels == 1 && rateHz == 0.0 && format == 3 ? &anything : nullptr;
}
void* lsl_create_outlet(void* info, std::int32_t, std::int32_t) { return info; }
double lsl_local_clock() { return 1000.0; }
std::int32_t lsl_push_sample_strt(void*, const char** text, double timestamp) {
    note(text[0], 1e3 * (timestamp - 1000.0));
    return 0;
}
void lsl_destroy_outlet(void*) { note("closed", 0.0); }
void lsl_destroy_streaminfo(void*) {}
}
