// SPDX-License-Identifier: MIT
// physvib_live_explain: why nothing is felt of a world on an open device.
#include "Api/Live/Lives.h"

using namespace physvib;
using namespace physvib::api;

namespace {

const char* holderOf(const MuteRequests& silence) noexcept {
    if (silence.isHeldBy(MuteRequester::osc)) return "OSC (/physvib/silence)";
    if (silence.isHeldBy(MuteRequester::standardInput)) return "a line of standard input";
    return "physvib_live_silence";
}

physvib_renderer_settings settingsOf(const PhantomPanner& panner) {
    physvib_renderer_settings settings;
    physvib_renderer_settings_init(&settings, sizeof settings);
    settings.law = static_cast<int>(panner.partLaw());
    settings.exponent = panner.exponent();
    settings.field_width_m = panner.fieldWidthMetres();
    settings.field_height_m = panner.fieldHeightMetres();
    settings.layout = layoutOf(panner.layout());
    return settings;
}

} // namespace

int physvib_live_explain(physvib_live name, physvib_world world, char* text, size_t size) {
    return in(name, [&](Live& live) {
        const LiveStatus now = live.status();
        const physvib_renderer_settings settings = settingsOf(live.session().panner());
        physvib_output_facts facts;
        physvib_output_facts_init(&facts, sizeof facts);
        facts.is_missing = live.output().isPlaying() ? 0 : 1;
        facts.is_silent = live.output().isSilent() ? 1 : 0;
        facts.silent_by = holderOf(live.output().silence());
        const std::string dropped = droppedWords(live.session().pulse().dropped());
        facts.trouble = now.trouble.empty() ? dropped.c_str() : now.trouble.c_str();
        facts.level = static_cast<double>(live.output().level());
        facts.muted_channels = static_cast<physvib_int64>(live.session().rendered().mutedChannels());
        facts.late = static_cast<physvib_int64>(now.render.late);
        facts.rejected = static_cast<physvib_int64>(now.render.rejected);
        facts.without_part = static_cast<physvib_int64>(now.render.withoutPart);
        facts.renderer = &settings;
        const int length = physvib_world_explain_output(world, &facts, text, size);
        return length < 0 ? fail(length, physvib_error()) : length;
    });
}
