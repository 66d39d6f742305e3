// SPDX-License-Identifier: GPL-3.0-or-later
// The least an LV2 host can be: one instance of a module of four channels, its ports, blocks, on demand.
#pragma once
#include "Parameters.h"
#include <array>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>
#include <functional>
#include <lv2/atom/forge.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/core/lv2.h>
#include <lv2/options/options.h>
#include <lv2/patch/patch.h>
#include <lv2/state/state.h>
#include <lv2/urid/urid.h>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace physvib::test {

class RawLv2 {
public:
    static constexpr std::size_t channels = 4;
    enum Port : std::uint32_t { input = channels, output, latencyOut, freeWheeling, isEnabled, firstControl };

    /// `nominal` 0: not told, as some hosts do. `hasMusic`: the module with two ports for music.
    RawLv2(int largestBlock, int nominal, double rate = 48000.0, bool hasMusic = false) {
        const std::string name = hasMusic ? "PhysVib-Music" : "PhysVib",
                          bundle = PHYSVIB_PLUGINS "/" + name + ".lv2/";
        if (hasMusic) uri_ += ":music";
        module_ = dlopen((bundle + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!module_) return;
        descriptor_ =
            reinterpret_cast<const LV2_Descriptor* (*)(std::uint32_t)>(dlsym(module_, "lv2_descriptor"))(0);
        largest_ = largestBlock;
        nominal_ = nominal;
        const auto whole = idOf(LV2_ATOM__Int), largestId = idOf(LV2_BUF_SIZE__maxBlockLength),
                   nominalId = idOf(LV2_BUF_SIZE__nominalBlockLength);
        const LV2_Options_Option largestOption{LV2_OPTIONS_INSTANCE, 0,     largestId,
                                               sizeof largest_,      whole, &largest_};
        const LV2_Options_Option nominalOption{LV2_OPTIONS_INSTANCE, 0,     nominalId,
                                               sizeof nominal_,      whole, &nominal_};
        const LV2_Options_Option end{};
        options_ = {largestOption, nominal > 0 ? nominalOption : end, end};
        features_ = {LV2_Feature{LV2_URID__map, &map_},
                     {LV2_BUF_SIZE__boundedBlockLength, nullptr},
                     {LV2_OPTIONS__options, options_.data()}};
        const LV2_Feature* const features[]{&features_[0], &features_[1], &features_[2], nullptr};
        handle_ = descriptor_->instantiate(descriptor_, rate, bundle.c_str(), features);
        if (!handle_) return;
        inputs_ = hasMusic ? 2 : 0;
        for (std::uint32_t c = 0; c < inputs_; ++c) {
            music[c].assign(static_cast<std::size_t>(largestBlock), 0.0f);
            descriptor_->connect_port(handle_, c, music[c].data());
        }
        connect(output, told_.data());
        connect(latencyOut, &latency);
        connect(freeWheeling, &offline);
        connect(isEnabled, &enabled);
        for (std::size_t p = 0; p < parameterCount; ++p)
            controls[p] = static_cast<float>(allParameters()[p].initial);
        move(largestBlock, controls.data());
        choose(0);
    }
    ~RawLv2() {
        if (handle_) descriptor_->cleanup(handle_);
        if (module_) dlclose(module_);
    }
    /// The ports of audio, events and parameters lie elsewhere from now on, with room for so many frames;
    /// parameters as they are now, or there.
    void move(int frames, float* parameters = nullptr) {
        for (std::uint32_t c = 0; c < channels; ++c) {
            out[c] = std::vector<float>(static_cast<std::size_t>(frames)); // made before the other is freed
            connect(c, out[c].data());
        }
        in_ = std::vector<std::uint64_t>(in_.size());
        connect(input, in_.data());
        if (!parameters) {
            moved_ = std::make_unique<std::array<float, parameterCount>>(controls);
            parameters = moved_->data();
        }
        for (std::uint32_t p = 0; p < parameterCount; ++p) connect(firstControl + p, parameters + p);
    }
    /// The preset of that number; the first is a world that moves by itself.
    void choose(std::int32_t program) {
        program_ = program;
        const auto retrieve = [](LV2_State_Handle host, std::uint32_t key, std::size_t* size,
                                 std::uint32_t* type, std::uint32_t* flags) -> const void* {
            auto& self = *static_cast<RawLv2*>(host);
            if (key != self.idOf(self.uri_ + ":Program")) return nullptr;
            *size = sizeof self.program_;
            *type = self.idOf(LV2_ATOM__Int);
            *flags = LV2_STATE_IS_POD;
            return &self.program_;
        };
        stateInterface().restore(handle_, retrieve, this, 0, nullptr);
    }

    /// A state as a host keeps it: by URI, type and bytes.
    struct Kept {
        std::string type;
        std::vector<char> bytes;
    };
    using State = std::map<std::string, Kept>;
    State save() {
        const auto store = [](LV2_State_Handle self, std::uint32_t key, const void* value, std::size_t size,
                              std::uint32_t type, std::uint32_t) {
            auto& [host, kept] = *static_cast<std::pair<RawLv2*, State>*>(self);
            const auto* const bytes = static_cast<const char*>(value);
            kept[host->uris_[key - 1]] = {host->uris_[type - 1], {bytes, bytes + size}};
            return LV2_STATE_SUCCESS;
        };
        std::pair<RawLv2*, State> all{this, {}};
        stateInterface().save(handle_, store, &all, 0, nullptr);
        return all.second;
    }
    void restore(const State& state) {
        const auto retrieve = [](LV2_State_Handle self, std::uint32_t key, std::size_t* size,
                                 std::uint32_t* type, std::uint32_t* flags) -> const void* {
            const auto& [host, kept] = *static_cast<std::pair<RawLv2*, const State*>*>(self);
            const auto found = kept->find(host->uris_[key - 1]);
            if (found == kept->end()) return nullptr;
            *size = found->second.bytes.size();
            *type = host->idOf(found->second.type);
            *flags = LV2_STATE_IS_POD;
            return found->second.bytes.data();
        };
        std::pair<RawLv2*, const State*> all{this, &state};
        stateInterface().restore(handle_, retrieve, &all, 0, nullptr);
    }

    bool isLoaded() const { return handle_ != nullptr; }
    /// For a window of it.
    LV2_Handle handle() const { return handle_; }
    LV2_URID idOf(const std::string& uri) {
        for (std::size_t i = 0; i < uris_.size(); ++i)
            if (uris_[i] == uri) return static_cast<LV2_URID>(i + 1);
        uris_.push_back(uri);
        return static_cast<LV2_URID>(uris_.size());
    }
    LV2_URID_Map& map() { return map_; }
    void* symbol(const char* name) const { return dlsym(module_, name); }
    void activate() { descriptor_->activate(handle_); }
    void deactivate() { descriptor_->deactivate(handle_); }

    /// A block; how many bytes of events the plug-in sent with it.
    std::size_t run(int frames) {
        LV2_Atom_Forge forge;
        LV2_Atom_Forge_Frame events, set;
        lv2_atom_forge_init(&forge, &map_);
        lv2_atom_forge_set_buffer(&forge, reinterpret_cast<std::uint8_t*>(in_.data()),
                                  in_.size() * sizeof in_[0]);
        lv2_atom_forge_sequence_head(&forge, &events, 0);
        for (const auto& [frame, parameter, value] : points) {
            lv2_atom_forge_frame_time(&forge, frame);
            lv2_atom_forge_object(&forge, &set, 0, idOf(LV2_PATCH__Set));
            lv2_atom_forge_key(&forge, idOf(LV2_PATCH__property));
            lv2_atom_forge_urid(&forge, idOf(uri_ + ":" + parameter));
            lv2_atom_forge_key(&forge, idOf(LV2_PATCH__value));
            lv2_atom_forge_float(&forge, value);
            lv2_atom_forge_pop(&forge, &set);
        }
        points.clear();
        if (say) std::exchange(say, {})(forge);
        lv2_atom_forge_pop(&forge, &events);
        auto* const sent = reinterpret_cast<LV2_Atom_Sequence*>(told_.data());
        sent->atom = {static_cast<std::uint32_t>(sizeof told_ - sizeof(LV2_Atom)), idOf(LV2_ATOM__Chunk)};
        call(*descriptor_, handle_, static_cast<std::uint32_t>(frames));
        return sent->atom.size - sizeof(LV2_Atom_Sequence_Body);
    }
    /// What every enchanter plays in that many blocks.
    std::vector<float> play(int blocks, int frames) {
        std::vector<float> signal;
        for (int b = 0; b < blocks; ++b) {
            run(frames);
            for (const auto& channel : out)
                signal.insert(signal.end(), channel.begin(), channel.begin() + frames);
        }
        return signal;
    }

    struct Point {
        int frame;
        std::string parameter; // id
        float value;           // in its unit
    };
    std::vector<Point> points;                ///< of the next block, in frame order
    std::function<void(LV2_Atom_Forge&)> say; ///< what else it has
    std::array<std::vector<float>, 2> music;  ///< of the next block, where there are ports for it
    std::array<std::vector<float>, channels> out;
    std::array<float, parameterCount> controls{}; ///< the parameters' ports, each in its unit
    float latency = 0.0f, offline = 1.0f, enabled = 1.0f;
    /// How a block is run.
    void (*call)(const LV2_Descriptor& to, LV2_Handle handle, std::uint32_t frames) =
        [](const LV2_Descriptor& to, LV2_Handle handle, std::uint32_t frames) { to.run(handle, frames); };

private:
    void connect(std::uint32_t port, void* data) { descriptor_->connect_port(handle_, inputs_ + port, data); }
    const LV2_State_Interface& stateInterface() const {
        return *static_cast<const LV2_State_Interface*>(descriptor_->extension_data(LV2_STATE__interface));
    }
    std::string uri_ = "urn:physvib:plugin";
    std::vector<std::string> uris_;
    LV2_URID_Map map_{this, [](LV2_URID_Map_Handle host, const char* uri) {
                          return static_cast<RawLv2*>(host)->idOf(uri);
                      }};
    std::array<LV2_Options_Option, 3> options_{};
    std::array<LV2_Feature, 3> features_{};
    std::int32_t largest_ = 0, nominal_ = 0, program_ = 0;
    std::uint32_t inputs_ = 0;
    std::vector<std::uint64_t> in_ = std::vector<std::uint64_t>(1 << 17);
    alignas(8) std::array<std::byte, 65536> told_{};
    std::unique_ptr<std::array<float, parameterCount>> moved_;
    void* module_ = nullptr;
    const LV2_Descriptor* descriptor_ = nullptr;
    LV2_Handle handle_ = nullptr;
};

} // namespace physvib::test
