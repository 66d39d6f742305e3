// SPDX-License-Identifier: MIT
// C functions that explain, in one sentence, why a world or an output produces no vibration.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <string>
#include <utility>

using namespace physvib;
using namespace physvib::api;

namespace {

int copyText(const std::string& sentence, char* text, size_t size) noexcept {
    const std::size_t length = std::min(sentence.size(), size - 1);
    std::copy_n(sentence.data(), length, text);
    text[length] = '\0';
    return static_cast<int>(sentence.size());
}

// Increase of a counter since the last call. A total below the last one comes from another output, so all of
// it counts.
std::uint64_t countSince(std::uint64_t& lastTotal, std::uint64_t total) noexcept {
    const std::uint64_t previous = std::exchange(lastTotal, total);
    return total >= previous ? total - previous : total;
}

int writeExplanation(physvib_world handle, OutputFacts* output, char* text, size_t size) noexcept {
    return withObject(handle, [&](World& world) {
        if (text == nullptr || size == 0) return argumentError("text: expected a place for it");
        if (output != nullptr) {
            output->late = countSince(world.late, output->late);
            output->dropped = countSince(world.dropped, output->dropped);
            output->rejected = countSince(world.rejected, output->rejected);
            output->withoutPart = countSince(world.withoutPart, output->withoutPart);
        }
        const ContactCounts recent = world.feed.takeRecent();
        return copyText(physvib::explain(recent, world.feed.counts(), output), text, size);
    });
}

OutputFacts outputFactsOf(Renderer& renderer, const LastChanges& changes) {
    const std::lock_guard lock{renderer.readerMutex};
    const RenderStatus status = renderer.status.read();
    const double nowNs = static_cast<double>(status.framesRendered) / renderer.rateHz * 1.0e9;
    OutputFacts output;
    output.isMissing = status.framesRendered == 0;
    if (output.isMissing) output.error = "no samples have been pulled from the renderer";
    output.isSilent = nowNs < static_cast<double>(changes.silentUntilNs);
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

std::string_view viewOrEmpty(const char* text) noexcept { return text == nullptr ? "" : text; }

} // namespace

int physvib_output_facts_init(physvib_output_facts* facts, size_t size) {
    auto defaults = zeroed<physvib_output_facts>();
    defaults.level = 1.0;
    return writeStruct(facts, size, defaults);
}

int physvib_world_note(physvib_world handle, int body, int note) {
    return withObject(handle, [&](World& world) {
        if (note < PHYSVIB_NOTE_SENSOR || note > PHYSVIB_NOTE_ASLEEP)
            return argumentError("note: expected one of PHYSVIB_NOTE_...");
        return codeFromError(world.feed.note(body, static_cast<EngineNote>(note)));
    });
}
static_assert(PHYSVIB_NOTE_SENSOR == static_cast<int>(EngineNote::sensor) &&
              PHYSVIB_NOTE_ASLEEP == static_cast<int>(EngineNote::asleep));

int physvib_world_explain(physvib_world world, char* text, size_t size) {
    return writeExplanation(world, nullptr, text, size);
}

int physvib_world_explain_output(physvib_world world, const physvib_output_facts* facts, char* text,
                                 size_t size) {
    physvib_output_facts callerFacts;
    if (!readStruct(facts, callerFacts, physvib_output_facts_init)) return PHYSVIB_ERROR_ARGUMENT;
    if (!(callerFacts.level >= 0.0)) return argumentError("level: expected a gain of 0 or more");
    RendererSettings renderer;
    if (callerFacts.renderer != nullptr && !readRenderer(callerFacts.renderer, renderer))
        return PHYSVIB_ERROR_ARGUMENT;
    const auto nonNegative = [](physvib_int64 value) {
        return static_cast<std::uint64_t>(std::max<physvib_int64>(value, 0));
    };
    OutputFacts output{callerFacts.is_missing != 0,
                       callerFacts.is_silent != 0,
                       viewOrEmpty(callerFacts.silent_by),
                       viewOrEmpty(callerFacts.trouble),
                       std::max(0, callerFacts.channels),
                       callerFacts.level,
                       static_cast<std::uint64_t>(callerFacts.muted_channels),
                       nonNegative(callerFacts.late),
                       nonNegative(callerFacts.dropped),
                       nonNegative(callerFacts.rejected),
                       callerFacts.renderer != nullptr ? &renderer.panner : nullptr,
                       nonNegative(callerFacts.without_part)};
    return writeExplanation(world, &output, text, size);
}

int physvib_renderer_explain(physvib_renderer handle, physvib_world world, char* text, size_t size) {
    return catchExceptions([&] {
        const auto renderer = borrow(handle);
        if (!renderer) return unknownHandleError();
        LastChanges changes;
        {
            const std::lock_guard lock{renderer->producerMutex};
            changes = renderer->changes;
        }
        OutputFacts output = outputFactsOf(*renderer, changes);
        return writeExplanation(world, &output, text, size);
    });
}
