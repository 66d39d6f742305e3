// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-studies-recorded FOLDER PROTOCOL.json DEVICE: a participant takes a whole study of worlds in the
// mixer's window, on a real device at a master level of 0 dB: feels each part of each trial to its end (where
// there are hands: drags and tilts for as long as asked), answers anything.
#include "Host/Devices/HostDrivers.h"
#include "Live/Devices/AudioDevice.h"
#include "Participant.h"

namespace physvib {
namespace {

class Recorded {
public:
    Recorded(const juce::File& folder, const std::string& device)
        : participant_{hostAudioDrivers, device} {
        participant_.tab().setFolder(folder);
        participant_.model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
        participant_.model.setDisplayWidth(1440.0 / 4000.0);
    }

    /// Empty, or why the study did not come to its end.
    std::string take(const std::string& protocol) {
        auto& p = participant_;
        if (!test::runUntil([&] { return p.model.output().sampleRateHz() > 0; }))
            return "the device did not open";
        if (auto error = p.tab().chooseProtocol(protocol); !error.empty()) return error;
        if (auto error = p.tab().begin(); !error.empty()) return error;
        p.pump();
        while (p.screen()->page() != StudyScreen::Page::done) {
            if (p.screen()->page() == StudyScreen::Page::error) return "the screen shows a fault";
            if (p.screen()->page() != StudyScreen::Page::trial)
                p.click("Next");
            else if (auto error = takeTrial(); !error.empty())
                return error;
            p.pump();
        }
        return {};
    }

private:
    std::string takeTrial() {
        auto& p = participant_;
        const int taken = p.experiment().answeredTrials();
        const auto parts = static_cast<int>(p.experiment().trial().parts.size());
        const auto scales = p.experiment().session().scales;
        if (p.experiment().session().answerKind() == AnswerKind::number) return estimate();
        for (int part = 1; part <= parts; ++part)
            if (!(scales.empty() ? fall() : shake(part)))
                return "trial " + std::to_string(taken + 1) + ": part " + std::to_string(part) +
                       " was not felt";
        if (scales.empty())
            p.click("Answer: number 1");
        else
            p.click("Pause");
        for (const std::string& scale : scales) {
            const juce::String title =
                juce::String{scale}.substring(0, 1).toUpperCase() + juce::String{scale}.substring(1);
            if (!p.canUse(title)) return title.toStdString() + " cannot be set";
            p.click(title, 60.0f);
        }
        p.click("Next");
        return test::runUntil([&] { return p.experiment().answeredTrials() > taken; })
                   ? ""
                   : "trial " + std::to_string(taken + 1) + " was not taken";
    }

    /// Feels it until it left, however often the device fails meanwhile.
    std::string estimate() {
        auto& p = participant_;
        const int taken = p.experiment().answeredTrials();
        const auto isTaken = [&] {
            p.pump();
            if (p.experiment().isDone() || p.experiment().answeredTrials() > taken) return true;
            if (p.screen()->page() != StudyScreen::Page::trial || p.screen()->isStimulusPlaying())
                return false;
            if (!p.screen()->answers()->isEnabled())
                p.screen()->keyPressed(juce::KeyPress{juce::KeyPress::spaceKey});
            else if (!p.screen()->answers()->isComplete())
                p.write("Number", "7");
            else
                p.screen()->keyPressed(juce::KeyPress{juce::KeyPress::returnKey});
            return false;
        };
        return test::runUntil(isTaken, 60.0) ? "" : "trial " + std::to_string(taken + 1) + " never left";
    }

    bool fall() {
        auto& p = participant_;
        const int before = p.screen()->plays();
        p.space();
        const bool isBegun =
            test::runUntil([&] { return p.screen()->plays() > before && p.screen()->isStimulusPlaying(); });
        return isBegun && test::runUntil([&] { return p.pump(), !p.screen()->isStimulusPlaying(); });
    }

    bool shake(int part) {
        auto& p = participant_;
        auto& world = p.screen()->world().world();
        p.type(juce::String{part});
        if (!test::runUntil([&] { return p.pump(), world.isMoving() && p.screen()->plays() == part; }))
            return false;
        auto& view = p.world();
        const double least = p.experiment().session().minSeconds;
        for (int drag = 0; world.playedSeconds() < least + 0.3; ++drag) {
            const auto body =
                p.view.getLocalPoint(&view, view.pixelOfBody("large " + std::to_string(1 + drag % 3)));
            p.drag(body, body + juce::Point<float>{drag % 2 == 0 ? 60.0f : -60.0f, -40.0f}); // 18 mm
            p.key(drag % 8 < 4 ? juce::KeyPress::leftKey : juce::KeyPress::rightKey);
            test::runFor(0.15);
        }
        return true;
    }

    test::Participant participant_;
};

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    juce::JUCEApplicationBase::createInstance = []() -> juce::JUCEApplicationBase* { return nullptr; };
    const juce::ScopedJuceInitialiser_GUI juce;
    const std::string fault = physvib::Recorded{juce::File{argv[1]}, argv[3]}.take(argv[2]);
    if (!fault.empty()) std::puts(fault.c_str());
    return fault.empty() ? 0 : 1;
}
