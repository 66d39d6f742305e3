// SPDX-License-Identifier: GPL-3.0-or-later
// The processor, or a finished module of it in JUCE's host, that plays notes in every block.
#pragma once
#include "Plugin/PluginTesting.h"
#include <juce_audio_processors/juce_audio_processors.h>

// The finished modules in JUCE's host.
namespace physvib::test {

inline const juce::String vst3Identifier = PHYSVIB_PLUGINS "/PhysVib.vst3",
                          lv2Identifier = "urn:physvib:plugin";

/// VST3 goes by its bundle, LV2 by the address that its bundle tells.
struct Format {
    explicit Format(bool isVst3) {
        if (isVst3)
            format = std::make_unique<juce::VST3PluginFormat>();
        else
            format = std::make_unique<juce::LV2PluginFormat>();
        format->searchPathsForPlugins(juce::FileSearchPath{PHYSVIB_PLUGINS}, true, false);
    }
    std::unique_ptr<juce::AudioPluginInstance> load(const juce::String& identifier) const {
        juce::OwnedArray<juce::PluginDescription> found;
        format->findAllTypesForFile(found, identifier);
        if (found.isEmpty()) return nullptr;
        juce::String error;
        auto plugin = format->createInstanceFromDescription(*found[0], 48000.0, 512, error);
        EXPECT_EQ(error, "");
        return plugin;
    }
    std::unique_ptr<juce::AudioPluginFormat> format;
};

/// JUCE's host calls `lv2:enabled` a parameter "Bypass" as well: not that one.
inline juce::AudioProcessorParameter* named(const juce::AudioPluginInstance& plugin, std::string_view name,
                                            const juce::AudioProcessorParameter* notThis = nullptr) {
    for (auto* p : plugin.getParameters())
        if (p != notThis && p->getName(100).toStdString() == name) return p;
    return nullptr;
}

/// Of what is played, and of a switch that closes, in frames.
constexpr int block = 512, ramp = 480;

enum class Kind { processor, vst3, lv2 };

/// The processor or a module of it, with notes in every block: there is always something to silence.
class Player {
public:
    explicit Player(Kind kindOf)
        : kind{kindOf} {
        if (kind == Kind::processor)
            own_ = std::make_unique<PluginProcessor>("PhysVib", BusPlan{});
        else
            hosted_ = Format{kind == Kind::vst3}.load(kind == Kind::vst3 ? vst3Identifier : lv2Identifier);
        plugin().setPlayHead(&playHead);
        playHead.isThere = playHead.isPlaying = true;
    }
    ~Player() {
        plugin().releaseResources();
        plugin().setPlayHead(nullptr);
    }
    juce::AudioProcessor& plugin() { return own_ ? static_cast<juce::AudioProcessor&>(*own_) : *hosted_; }

    void prepare(bool isOffline) {
        plugin().setNonRealtime(isOffline);
        buffer_ = prepareBlocks(plugin(), block);
    }
    /// The largest sample from frame `from` of the first block on.
    float peakOf(int blocks, int from = 0) {
        float peak = 0.0f;
        for (int b = 0; b < blocks; ++b, from = std::max(0, from - block)) {
            juce::MidiBuffer midi;
            midi.swapWith(next);
            midi.addEvent(juce::MidiMessage::noteOn(1, 36 + count_ % 12, juce::uint8{127}), 7);
            ++count_;
            buffer_.clear();
            plugin().processBlock(buffer_, midi);
            if (playHead.isPlaying) playHead.frame += block;
            if (from < block) peak = std::max(peak, buffer_.getMagnitude(from, block - from));
            // the pace of a device
            if (!plugin().isNonRealtime())
                std::this_thread::sleep_for(std::chrono::microseconds{block * 1'000'000 / 48'000});
        }
        return peak;
    }

    /// Whether it is felt, soon; a busy machine may make it late.
    bool isFelt() {
        for (int b = 0; b < 300; ++b)
            if (peakOf(1) > 0.01f) return true;
        return false;
    }

    /// Our own switch, as hosts automate it, and that of the host.
    juce::AudioProcessorParameter& bypass() {
        return own_ ? own_->parameter(Parameter::bypass)
                    : *named(*hosted_, "Bypass", kind == Kind::lv2 ? &hostsBypass() : nullptr);
    }
    juce::AudioProcessorParameter& hostsBypass() { return *plugin().getBypassParameter(); }

    /// As from a saved session. The hosts' wrapping of our chunk is JUCE's own.
    void load(const PluginState& state) {
        const std::string json = pluginStateJson(state);
        juce::MemoryBlock chunk{json.data(), json.size()};
        if (kind == Kind::vst3) {
            juce::XmlElement xml{"VST3PluginState"};
            xml.createNewChildElement("IComponent")->addTextElement(chunk.toBase64Encoding());
            juce::AudioProcessor::copyXmlToBinary(xml, chunk);
        }
        if (kind == Kind::lv2) {
            juce::MemoryBlock turtle;
            hosted_->getStateInformation(turtle);
            const auto text = turtle.toString();
            const auto head = text.upToFirstOccurrenceOf("StateString", true, false).length();
            // base64 has no quotes
            const auto from = text.indexOfChar(head, '"'), to = text.indexOfChar(from + 1, '"');
            const auto changed = text.substring(0, from + 1) + chunk.toBase64Encoding() + text.substring(to);
            chunk.replaceAll(changed.toRawUTF8(), changed.getNumBytesAsUTF8());
        }
        plugin().setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
    }

    const Kind kind;
    TestPlayHead playHead;
    juce::MidiBuffer next; ///< goes with the next block

private:
    std::unique_ptr<PluginProcessor> own_;
    std::unique_ptr<juce::AudioPluginInstance> hosted_;
    juce::AudioBuffer<float> buffer_;
    int count_ = 0;
};

constexpr int panicController = 20;

/// Loud, and with a controller that silences.
inline PluginState playing(bool isSilenced = false) {
    auto state = shakenBox();
    state.controllers = {{panicController, "bypass"}};
    state.parameters = {{"level", 0.0}, {"bypass", isSilenced ? 1.0 : 0.0}};
    return state;
}

} // namespace physvib::test
