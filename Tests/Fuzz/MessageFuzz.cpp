// SPDX-License-Identifier: MIT
// Fuzz target of messages in lines; what is taken is played for a while.
#include "Fuzzing.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "SessionFuzzing.h"
#include <array>

using namespace physvib;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::unique_ptr<Session> session = fuzz::makeSession();
    static std::array<std::array<float, 256>, 4> samples;
    const auto read = readInputLine(fuzz::asText(data, size), session->world().state().scene->materials, 4);
    const auto* message = std::get_if<PlainMessage>(&read.value);
    if (message == nullptr) return 0;
    session->prepare(8000, 256);
    session->advance();
    MessageRouter router{*session};
    const auto answer = router.handle(*message, nullptr, fuzz::anyClip);
    fuzz::demandLine(answer.error);
    fuzz::demand(answer || session->world().size().strikes == 0, "refused, and half done", answer.error);
    for (int block = 0; block < 4; ++block) {
        std::array<float*, 4> out{};
        for (std::size_t j = 0; j < out.size(); ++j) out[j] = samples[j].data();
        session->render(out.data(), 256, RenderMode::realtime);
        session->advance();
        for (const auto& channel : samples)
            for (const float sample : channel)
                fuzz::demand(sample >= -1.0f && sample <= 1.0f, "beyond full scale, or not a number");
    }
    return 0;
}
