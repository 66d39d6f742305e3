// SPDX-License-Identifier: MIT
// C functions that say why nothing is felt.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <string>
#include <utility>

using namespace physvib;
using namespace physvib::api;

namespace {

int write(const std::string& sentence, char* text, size_t size) noexcept {
    const std::size_t length = std::min(sentence.size(), size - 1);
    std::copy_n(sentence.data(), length, text);
    text[length] = '\0';
    return static_cast<int>(sentence.size());
}

// Outputs count since they were opened; of another output than last time, all counts.
std::uint64_t since(std::uint64_t& last, std::uint64_t now) noexcept {
    const std::uint64_t before = std::exchange(last, now);
    return now >= before ? now - before : now;
}

int explain(physvib_world name, OutputFacts* output, char* text, size_t size) noexcept {
    return in(name, [&](World& world) {
        if (text == nullptr || size == 0) return nothingThere("text: expected a place for it");
        if (output != nullptr) {
            output->late = since(world.late, output->late);
            output->dropped = since(world.dropped, output->dropped);
            output->rejected = since(world.rejected, output->rejected);
            output->withoutPart = since(world.withoutPart, output->withoutPart);
        }
        const ContactCounts recent = world.feed.takeRecent();
        return write(physvib::explain(recent, world.feed.counts(), output), text, size);
    });
}

OutputFacts outputOf(Renderer& renderer, const LastChanges& changes) {
    const std::lock_guard lock{renderer.readers};
    const RenderStatus status = renderer.status.read();
    const double now = static_cast<double>(status.framesRendered) / renderer.rateHz * 1.0e9;
    OutputFacts output;
    output.isMissing = status.framesRendered == 0;
    if (output.isMissing) output.trouble = "no samples have been pulled from the renderer";
    output.isSilent = now < static_cast<double>(changes.silentUntilNs);
    output.silentBy = "physvib_renderer_silence";
    output.channels = renderer.channels;
    output.levelGain = changes.level;
    output.mutedChannels = changes.mutedChannels();
    output.late = status.late;
    output.dropped = renderer.source.events.overflows();
    output.rejected = status.rejected;
    output.panner = &changes.panner;
    output.withoutPart = status.withoutPart;
    return output;
}

std::string_view viewOf(const char* text) noexcept { return text == nullptr ? "" : text; }

} // namespace

int physvib_output_facts_init(physvib_output_facts* facts, size_t size) {
    auto usual = zeroed<physvib_output_facts>();
    usual.level = 1.0;
    return begin(facts, size, usual);
}

int physvib_world_note(physvib_world name, int body, int note) {
    return in(name, [&](World& world) {
        if (note < PHYSVIB_NOTE_SENSOR || note > PHYSVIB_NOTE_ASLEEP)
            return nothingThere("note: expected one of PHYSVIB_NOTE_...");
        return resultOf(world.feed.note(body, static_cast<EngineNote>(note)));
    });
}
static_assert(PHYSVIB_NOTE_SENSOR == static_cast<int>(EngineNote::sensor) &&
              PHYSVIB_NOTE_ASLEEP == static_cast<int>(EngineNote::asleep));

int physvib_world_explain(physvib_world world, char* text, size_t size) {
    return explain(world, nullptr, text, size);
}

int physvib_world_explain_output(physvib_world world, const physvib_output_facts* facts, char* text,
                                 size_t size) {
    physvib_output_facts taken;
    if (!take(facts, taken, physvib_output_facts_init)) return PHYSVIB_ERROR_ARGUMENT;
    if (!(taken.level >= 0.0)) return nothingThere("level: expected a gain of 0 or more");
    physvib_renderer_settings settings;
    RendererSettings renderer;
    if (taken.renderer != nullptr) {
        if (!take(taken.renderer, settings, physvib_renderer_settings_init)) return PHYSVIB_ERROR_ARGUMENT;
        if (const auto fault = convert(settings, renderer); !fault.empty())
            return fail(PHYSVIB_ERROR_ARGUMENT, fault);
    }
    const auto count = [](physvib_int64 told) {
        return static_cast<std::uint64_t>(std::max<physvib_int64>(told, 0));
    };
    OutputFacts output{taken.is_missing != 0,
                       taken.is_silent != 0,
                       viewOf(taken.silent_by),
                       viewOf(taken.trouble),
                       std::max(0, taken.channels),
                       taken.level,
                       static_cast<std::uint64_t>(taken.muted_channels),
                       count(taken.late),
                       count(taken.dropped),
                       count(taken.rejected),
                       taken.renderer != nullptr ? &renderer.panner : nullptr,
                       count(taken.without_part)};
    return explain(world, &output, text, size);
}

int physvib_renderer_explain(physvib_renderer name, physvib_world world, char* text, size_t size) {
    return guarded([&] {
        const auto renderer = use(name);
        if (!renderer) return unknownHandle();
        LastChanges changes;
        {
            const std::lock_guard lock{renderer->producers};
            changes = renderer->changes;
        }
        OutputFacts output = outputOf(*renderer, changes);
        return explain(world, &output, text, size);
    });
}
