// SPDX-License-Identifier: MIT
// Opens ALSA's PCM streams, plays on them in blocks, and reads ALSA's list of devices.
#include "Live/Devices/AlsaDevice.h"
#include "Live/Session/System.h"
#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

namespace physvib {

namespace {

constexpr unsigned int ratesByPreferenceHz[] = {44100, 48000, 88200, 96000, 176400, 192000,
                                                32000, 22050, 16000, 11025, 8000};
constexpr unsigned int maxChannelCount = 256; // mixing devices claim 10,000
constexpr int maxWaitMs = 100;

// Memory for a structure of ALSA, whose size is known at run time only.
struct HardwareParameters {
    explicit HardwareParameters(const AlsaLibrary& alsa)
        : bytes(alsa.pcm_hw_params_sizeof()) {}
    snd_pcm_hw_params_t* get() { return reinterpret_cast<snd_pcm_hw_params_t*>(bytes.data()); }
    std::vector<char> bytes;
};

void discardAlsaMessage(const char*, int, const char*, int, const char*, ...) {}

// Prefers functions that were loaded with the program, so that a test can replace the clock of a device.
void* alsaFunction(void* library, const char* name) {
    void* const preloaded = findFunction(nullptr, name);
    return preloaded != nullptr ? preloaded : findFunction(library, name);
}

std::optional<AlsaLibrary> loadAlsa() {
    AlsaLibrary alsa;
    void* const library = openLibrary("libasound.so.2");
    bool hasAll = library != nullptr;
#define PHYSVIB_ALSA_FIND(name)                                                                              \
    if (hasAll) alsa.name = reinterpret_cast<decltype(alsa.name)>(alsaFunction(library, "snd_" #name));      \
    hasAll = hasAll && alsa.name != nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_FIND)
#undef PHYSVIB_ALSA_FIND
    if (!hasAll) return {};
    // Without a sound card, ALSA would print sixty lines to stderr for each scan.
    alsa.lib_error_set_handler(discardAlsaMessage);
    return alsa;
}

// True for variants of a device that is listed itself, and for names that play nowhere.
bool isVariantOrNull(const std::string& id) {
    return id.empty() || id == "null" || id.starts_with("default:") || id.starts_with("sysdefault:") ||
           id.starts_with("plughw:");
}

std::string joinedLines(const std::string& text) {
    std::string line;
    for (const char c : text) line += c == '\n' ? std::string{"; "} : std::string{c};
    return line;
}

} // namespace

int AlsaPcm::openId(const std::string& id) {
    close();
    return alsa_.pcm_open(&pcm_, id.c_str(), direction_, SND_PCM_NONBLOCK);
}

void AlsaPcm::close() {
    if (pcm_ != nullptr) alsa_.pcm_close(pcm_);
    pcm_ = nullptr;
}

AlsaRange AlsaPcm::queryRange() const {
    AlsaPcm probe{alsa_, id_, direction_};
    HardwareParameters parameters{alsa_};
    unsigned int minChannels = 0, maxChannels = 0;
    if (const int error = probe.openId(id_); error < 0)
        return {.isMissing = error != -EBUSY && error != -EAGAIN && error != -EACCES && error != -EPERM};
    if (alsa_.pcm_hw_params_any(probe.pcm_, parameters.get()) < 0 ||
        alsa_.pcm_hw_params_get_channels_min(parameters.get(), &minChannels) < 0 ||
        alsa_.pcm_hw_params_get_channels_max(parameters.get(), &maxChannels) < 0)
        return {};
    maxChannels = std::min(maxChannels, maxChannelCount);
    const auto* rate = std::ranges::find_if(ratesByPreferenceHz, [&](unsigned int hz) {
        return alsa_.pcm_hw_params_test_rate(probe.pcm_, parameters.get(), hz, 0) == 0;
    });
    return {static_cast<int>(std::min(minChannels, maxChannels)), static_cast<int>(maxChannels), false,
            rate != std::end(ratesByPreferenceHz) ? static_cast<int>(*rate) : 0};
}

bool AlsaPcm::hasFloats() const {
    HardwareParameters parameters{alsa_};
    return alsa_.pcm_hw_params_any(pcm_, parameters.get()) >= 0 &&
           alsa_.pcm_hw_params_test_format(pcm_, parameters.get(), SND_PCM_FORMAT_FLOAT) == 0;
}

std::string AlsaPcm::open(int channels, int& rateHz, int& blockFrames) {
    int error = openId(id_);
    if (error >= 0 && !hasFloats()) error = openId("plug:'" + id_ + "'");
    if (error == -EBUSY) return "is busy: another program has it open";
    if (error < 0) return alsa_.strerror(error);
    auto rate = static_cast<unsigned int>(rateHz);
    auto period = static_cast<snd_pcm_uframes_t>(blockFrames);
    error = chooseHardware(channels, rate, period);
    if (error >= 0) error = chooseSoftware(period);
    if (error >= 0) error = alsa_.pcm_prepare(pcm_);
    if (error < 0) {
        close();
        return alsa_.strerror(error);
    }
    channels_ = channels;
    rateHz = static_cast<int>(rate);
    blockFrames = static_cast<int>(period);
    return {};
}

int AlsaPcm::chooseHardware(int channels, unsigned int& rateHz, snd_pcm_uframes_t& periodFrames) {
    HardwareParameters parameters{alsa_};
    auto* const p = parameters.get();
    unsigned int periods = 4;
    int direction = 0;
    for (const int error :
         {alsa_.pcm_hw_params_any(pcm_, p),
          alsa_.pcm_hw_params_set_access(pcm_, p, SND_PCM_ACCESS_RW_INTERLEAVED),
          alsa_.pcm_hw_params_set_format(pcm_, p, SND_PCM_FORMAT_FLOAT),
          alsa_.pcm_hw_params_set_rate_near(pcm_, p, &rateHz, nullptr),
          alsa_.pcm_hw_params_set_channels(pcm_, p, static_cast<unsigned int>(channels)),
          alsa_.pcm_hw_params_set_periods_near(pcm_, p, &periods, &direction),
          alsa_.pcm_hw_params_set_period_size_near(pcm_, p, &periodFrames, &direction),
          alsa_.pcm_hw_params(pcm_, p), alsa_.pcm_hw_params_get_buffer_size(p, &bufferFrames_),
          alsa_.pcm_hw_params_get_period_size(p, &periodFrames, &direction),
          alsa_.pcm_hw_params_get_periods(p, &periods, &direction)})
        if (error < 0) return error;
    latencyFrames_ = static_cast<int>(periodFrames) * (static_cast<int>(periods) - 1); // as JACK estimates it
    return 0;
}

// The device starts with the first block, and plays silence in a gap instead of stopping.
int AlsaPcm::chooseSoftware(snd_pcm_uframes_t periodFrames) {
    std::vector<char> bytes(alsa_.pcm_sw_params_sizeof());
    auto* const p = reinterpret_cast<snd_pcm_sw_params_t*>(bytes.data());
    snd_pcm_uframes_t boundary = 0;
    for (const int error :
         {alsa_.pcm_sw_params_current(pcm_, p), alsa_.pcm_sw_params_get_boundary(p, &boundary),
          alsa_.pcm_sw_params_set_silence_threshold(pcm_, p, 0),
          alsa_.pcm_sw_params_set_silence_size(pcm_, p, boundary),
          alsa_.pcm_sw_params_set_start_threshold(pcm_, p, periodFrames),
          alsa_.pcm_sw_params_set_stop_threshold(pcm_, p, boundary), alsa_.pcm_sw_params(pcm_, p)})
        if (error < 0) return error;
    return 0;
}

void AlsaPcm::begin() {
    if (direction_ == SND_PCM_STREAM_CAPTURE) alsa_.pcm_start(pcm_);
}

// The device plays silence in a gap and does not report it: more free frames than the buffer has show a gap.
void AlsaPcm::countXrun() noexcept {
    const auto freeFrames = alsa_.pcm_avail_update(pcm_);
    const bool isLate = freeFrames > 0 && static_cast<snd_pcm_uframes_t>(freeFrames) > bufferFrames_;
    if (isLate && !isInXrun_) ++xruns_;
    isInXrun_ = isLate;
}

AlsaPcm::Transfer AlsaPcm::transfer(float* samples, int frames, int& done) noexcept {
    done = 0;
    if (alsa_.pcm_wait(pcm_, maxWaitMs) == 0) return Transfer::none;
    countXrun();
    const auto count = static_cast<snd_pcm_uframes_t>(frames);
    const auto moved = direction_ == SND_PCM_STREAM_PLAYBACK ? alsa_.pcm_writei(pcm_, samples, count)
                                                             : alsa_.pcm_readi(pcm_, samples, count);
    if (moved == -EAGAIN) return Transfer::none;
    if (moved >= 0) return done = static_cast<int>(moved), Transfer::some;
    if (moved == -EPIPE) ++xruns_;
    if (alsa_.pcm_recover(pcm_, static_cast<int>(moved), 1) < 0) return Transfer::failed;
    begin();
    return Transfer::none;
}

const AlsaLibrary* alsaLibrary() {
    static const std::optional<AlsaLibrary> loaded = loadAlsa();
    return loaded ? &*loaded : nullptr;
}

AlsaDevice::AlsaDevice(const AlsaLibrary& alsa, std::string name, const std::string& outputId,
                       const std::string& inputId)
    : name_{std::move(name)}
    , in_{alsa, inputId, SND_PCM_STREAM_CAPTURE}
    , out_{alsa, outputId, SND_PCM_STREAM_PLAYBACK} {
    if (!inputId.empty()) inputRange_ = in_.pcm.queryRange();
    if (!outputId.empty()) outputRange_ = out_.pcm.queryRange();
}

std::string AlsaDevice::Direction::open(const ChannelSet& wanted, const AlsaRange& range, int& rateHz,
                                        int& blockFrames) {
    active.clear();
    for (const int k : wanted)
        if (pcm.hasId() && (k < range.maxChannels || range.maxChannels == 0)) active.insert(k);
    if (active.empty()) return {};
    return pcm.open(std::max(range.minChannels, *active.rbegin() + 1), rateHz, blockFrames);
}

void AlsaDevice::Direction::prepare(int blockFrames) {
    const auto frames = static_cast<std::size_t>(blockFrames);
    interleaved.assign(frames * static_cast<std::size_t>(pcm.channels()), 0.0f);
    channels.assign(active.size(), std::vector<float>(frames, 0.0f));
    buffers.clear();
    for (auto& channel : channels) buffers.push_back(channel.data());
}

void AlsaDevice::Direction::copy(bool isOutput) noexcept {
    const auto stride = static_cast<std::size_t>(pcm.channels());
    auto channel = channels.begin();
    for (const int k : active) {
        float* position = interleaved.data() + k;
        for (float& sample : *channel++) {
            (isOutput ? *position : sample) = isOutput ? sample : *position;
            position += stride;
        }
    }
}

std::string AlsaDevice::open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                             int blockFrames) {
    close();
    rateHz_ = sampleRateHz > 0 ? sampleRateHz : std::max(outputRange_.rateHz, inputRange_.rateHz);
    blockFrames_ = blockFrames > 0 ? blockFrames : defaultBlockFrames();
    std::string error = out_.open(outputs, outputRange_, rateHz_, blockFrames_);
    const int outputRateHz = rateHz_;
    if (error.empty()) error = in_.open(inputs, inputRange_, rateHz_, blockFrames_);
    if (error.empty() && !out_.pcm.isOpen())
        error = "expected an output of the device, found none of those wanted";
    if (error.empty() && outputRateHz != rateHz_)
        error = "its inputs run at " + std::to_string(rateHz_) + " Hz, its outputs at " +
                std::to_string(outputRateHz) + " Hz; expected one rate";
    if (!error.empty()) return close(), error;
    in_.prepare(blockFrames_);
    out_.prepare(blockFrames_);
    isEnding_ = hasFailed_ = false;
    thread_ = std::thread{[this] { run(); }};
    return {};
}

void AlsaDevice::close() {
    stop();
    isEnding_ = true;
    if (thread_.joinable()) thread_.join(); // it waits for the device for 100 ms at a time
    in_.pcm.close();
    out_.pcm.close();
}

void AlsaDevice::start(AudioDeviceCallback& callback) {
    if (isOpen()) slot_.begin(*this, callback);
}

void AlsaDevice::stop() {
    if (AudioDeviceCallback* const callback = slot_.end()) callback->stopped();
}

// Transfers one whole block. False: the device is being closed, or has gone.
bool AlsaDevice::transferAll(Direction& direction) noexcept {
    const auto stride = static_cast<std::size_t>(direction.pcm.channels());
    for (int moved = 0, done = 0; moved < blockFrames_; moved += done) {
        float* const samples = direction.interleaved.data() + static_cast<std::size_t>(moved) * stride;
        if (direction.pcm.transfer(samples, blockFrames_ - moved, done) == AlsaPcm::Transfer::failed)
            hasFailed_ = true;
        if (isEnding_ || hasFailed_) return false;
    }
    return true;
}

void AlsaDevice::run() noexcept {
    raiseThreadPriority(true);
    const int inputs = static_cast<int>(in_.active.size()), outputs = static_cast<int>(out_.active.size());
    if (inputs > 0) in_.pcm.begin();
    while (!isEnding_) {
        if (inputs > 0 && !transferAll(in_)) return;
        in_.copy(false);
        slot_.call([&](AudioDeviceCallback* callback) {
            if (callback != nullptr)
                callback->processBlock(in_.buffers.data(), inputs, out_.buffers.data(), outputs,
                                       blockFrames_);
            else
                for (auto& channel : out_.channels) std::ranges::fill(channel, 0.0f);
        });
        out_.copy(true);
        if (!transferAll(out_)) return;
    }
}

std::string AlsaDriver::hintValue(const void* hint, const char* kind) const {
    char* const text = alsa_.device_name_get_hint(hint, kind);
    std::string found = text != nullptr ? text : "";
    std::free(text);
    return found;
}

std::string AlsaDriver::configString(snd_config_t* node) const {
    const char* text = nullptr;
    return alsa_.config_get_string(node, &text) >= 0 && text != nullptr ? text : "";
}

// A plug-in's definition names the next plug-in or contains its definition.
std::string AlsaDriver::lastPluginType(const std::string& id, int maxDepth) const {
    snd_config_t *root = nullptr, *definition = nullptr;
    if (maxDepth < 1 || alsa_.config_update_ref(&root) < 0) return {};
    std::string lastType, next;
    if (alsa_.config_search_definition(root, "pcm", id.c_str(), &definition) >= 0) {
        const auto child = [this](snd_config_t* node, std::initializer_list<const char*> keys) {
            snd_config_t* found = nullptr;
            for (const char* key : keys)
                if (found == nullptr && alsa_.config_search(node, key, &found) < 0) found = nullptr;
            return found;
        };
        for (auto* node = definition; node != nullptr && next.empty();) {
            if (auto* const type = child(node, {"type"})) lastType = configString(type);
            node = child(node, {"slave.pcm", "playback.pcm", "slave"});
            if (node != nullptr) next = configString(node);
        }
        alsa_.config_delete(definition);
    }
    alsa_.config_unref(root);
    const std::string deeperType = next.empty() ? std::string{} : lastPluginType(next, maxDepth - 1);
    return deeperType.empty() ? lastType : deeperType;
}

void AlsaDriver::addListed(const void* hint) {
    const std::string id = hintValue(hint, "NAME"), direction = hintValue(hint, "IOID");
    if (isVariantOrNull(id)) return;
    const std::string pluginType = lastPluginType(id);
    if (pluginType == "jack") return;
    std::string name = joinedLines(hintValue(hint, "DESC"));
    if (name.empty()) name = id;
    // ALSA reports both directions for dmix and dsnoop, but each has only one.
    if (direction != "Output" && !id.starts_with("dmix")) inputs_.push_back({id, name, pluginType});
    if (direction != "Input" && !id.starts_with("dsnoop")) outputs_.push_back({id, name, pluginType});
}

void AlsaDriver::addUnlisted(const std::string& id, const std::string& name) {
    if (std::ranges::find(outputs_, id, &Entry::id) != outputs_.end()) return;
    const std::string pluginType = lastPluginType(id);
    if (pluginType == "jack") return;
    const auto offers = [&](snd_pcm_stream_t direction) {
        const AlsaRange range = AlsaPcm{alsa_, id, direction}.queryRange();
        return range.maxChannels > 0 && range.rateHz > 0;
    };
    if (offers(SND_PCM_STREAM_PLAYBACK)) outputs_.push_back({id, name + " output", pluginType});
    if (offers(SND_PCM_STREAM_CAPTURE)) inputs_.push_back({id, name + " input", pluginType});
}

void AlsaDriver::scan() {
    inputs_.clear();
    outputs_.clear();
    void** hints = nullptr;
    if (alsa_.device_name_hint(-1, "pcm", &hints) == 0) {
        for (void** hint = hints; *hint != nullptr; ++hint) addListed(*hint);
        alsa_.device_name_free_hint(hints);
    }
    addUnlisted("default", "Default ALSA");
    addUnlisted("pulse", "Pulseaudio");
    for (List* list : {&inputs_, &outputs_}) {
        const auto rank = [](const Entry& e) { return e.id == "default" ? 0 : e.id == "pulse" ? 1 : 2; };
        std::ranges::stable_sort(*list, {}, rank);
        std::map<std::string, int> count, numbered;
        for (const Entry& entry : *list) ++count[entry.name];
        for (Entry& entry : *list)
            if (const std::string name = entry.name; count[name] > 1)
                entry.name += " (" + std::to_string(++numbered[name]) + ")";
    }
}

std::vector<std::string> AlsaDriver::deviceNames(bool inputs) {
    std::vector<std::string> names;
    const bool withPulse = !isJackRunning_();
    for (const Entry& entry : inputs ? inputs_ : outputs_)
        if (withPulse || entry.pluginType != "pulse") names.push_back(entry.name);
    return names;
}

std::string AlsaDriver::deviceId(const List& list, const std::string& name) {
    const auto entry = std::ranges::find(list, name, &Entry::name);
    return entry != list.end() ? entry->id : "";
}

std::unique_ptr<AudioDevice> AlsaDriver::create(const std::string& name, bool withInputs) {
    const std::string id = deviceId(outputs_, name);
    if (id.empty()) return nullptr;
    auto device = std::make_unique<AlsaDevice>(alsa_, name, id, withInputs ? deviceId(inputs_, name) : "");
    return device->exists() ? std::move(device) : nullptr;
}

} // namespace physvib
