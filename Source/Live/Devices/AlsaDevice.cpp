// SPDX-License-Identifier: MIT
// Sets up ALSA devices and plays on them.
#include "Live/Devices/AlsaDevice.h"
#include "Live/Session/System.h"
#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

namespace physvib {

namespace {

constexpr unsigned int usualRatesHz[] = {44100, 48000, 88200, 96000, 176400, 192000,
                                         32000, 22050, 16000, 11025, 8000};
constexpr unsigned int mostChannels = 256; // mixing devices claim 10,000
constexpr int longestWaitMs = 100;

// Memory for a structure of ALSA, whose size is known at run time only.
struct HardwareParameters {
    explicit HardwareParameters(const AlsaLibrary& alsa)
        : bytes(alsa.pcm_hw_params_sizeof()) {}
    snd_pcm_hw_params_t* get() { return reinterpret_cast<snd_pcm_hw_params_t*>(bytes.data()); }
    std::vector<char> bytes;
};

void ignoreAlsaMessage(const char*, int, const char*, int, const char*, ...) {}

// Prefers functions that were loaded with the program, so that a test can replace the clock of a device.
void* alsaFunction(void* library, const char* name) {
    void* const loadedBefore = functionIn(nullptr, name);
    return loadedBefore != nullptr ? loadedBefore : functionIn(library, name);
}

std::optional<AlsaLibrary> loadAlsa() {
    AlsaLibrary alsa;
    void* const library = openLibrary("libasound.so.2");
    bool isWhole = library != nullptr;
#define PHYSVIB_ALSA_FIND(name)                                                                              \
    if (isWhole) alsa.name = reinterpret_cast<decltype(alsa.name)>(alsaFunction(library, "snd_" #name));     \
    isWhole = isWhole && alsa.name != nullptr;
    PHYSVIB_ALSA_FUNCTIONS(PHYSVIB_ALSA_FIND)
#undef PHYSVIB_ALSA_FIND
    if (!isWhole) return {};
    // Without a sound card, ALSA would print sixty lines to stderr for each scan.
    alsa.lib_error_set_handler(ignoreAlsaMessage);
    return alsa;
}

// True for variants of devices that have an entry of their own, and for names that play nowhere.
bool isLeftOut(const std::string& id) {
    return id.empty() || id == "null" || id.starts_with("default:") || id.starts_with("sysdefault:") ||
           id.starts_with("plughw:");
}

std::string inOneLine(const std::string& text) {
    std::string line;
    for (const char c : text) line += c == '\n' ? std::string{"; "} : std::string{c};
    return line;
}

} // namespace

int AlsaPcm::openAs(const std::string& id) {
    close();
    return alsa_.pcm_open(&pcm_, id.c_str(), direction_, SND_PCM_NONBLOCK);
}

void AlsaPcm::close() {
    if (pcm_ != nullptr) alsa_.pcm_close(pcm_);
    pcm_ = nullptr;
}

AlsaRange AlsaPcm::range() const {
    AlsaPcm other{alsa_, id_, direction_};
    HardwareParameters parameters{alsa_};
    unsigned int least = 0, most = 0;
    if (const int fault = other.openAs(id_); fault < 0)
        return {.isMissing = fault != -EBUSY && fault != -EAGAIN && fault != -EACCES && fault != -EPERM};
    if (alsa_.pcm_hw_params_any(other.pcm_, parameters.get()) < 0 ||
        alsa_.pcm_hw_params_get_channels_min(parameters.get(), &least) < 0 ||
        alsa_.pcm_hw_params_get_channels_max(parameters.get(), &most) < 0)
        return {};
    most = std::min(most, mostChannels);
    const auto* rate = std::ranges::find_if(usualRatesHz, [&](unsigned int hz) {
        return alsa_.pcm_hw_params_test_rate(other.pcm_, parameters.get(), hz, 0) == 0;
    });
    return {static_cast<int>(std::min(least, most)), static_cast<int>(most), false,
            rate != std::end(usualRatesHz) ? static_cast<int>(*rate) : 0};
}

bool AlsaPcm::hasFloats() const {
    HardwareParameters parameters{alsa_};
    return alsa_.pcm_hw_params_any(pcm_, parameters.get()) >= 0 &&
           alsa_.pcm_hw_params_test_format(pcm_, parameters.get(), SND_PCM_FORMAT_FLOAT) == 0;
}

std::string AlsaPcm::open(int channels, int& rateHz, int& blockFrames) {
    int fault = openAs(id_);
    if (fault >= 0 && !hasFloats()) fault = openAs("plug:'" + id_ + "'");
    if (fault == -EBUSY) return "is busy: another program has it open";
    if (fault < 0) return alsa_.strerror(fault);
    auto rate = static_cast<unsigned int>(rateHz);
    auto period = static_cast<snd_pcm_uframes_t>(blockFrames);
    fault = chooseHardware(channels, rate, period);
    if (fault >= 0) fault = chooseSoftware(period);
    if (fault >= 0) fault = alsa_.pcm_prepare(pcm_);
    if (fault < 0) {
        close();
        return alsa_.strerror(fault);
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
    for (const int fault :
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
        if (fault < 0) return fault;
    latencyFrames_ = static_cast<int>(periodFrames) * (static_cast<int>(periods) - 1); // as JACK estimates it
    return 0;
}

// Playing begins with the first block. After a gap the device goes on by itself, with silence.
int AlsaPcm::chooseSoftware(snd_pcm_uframes_t periodFrames) {
    std::vector<char> bytes(alsa_.pcm_sw_params_sizeof());
    auto* const p = reinterpret_cast<snd_pcm_sw_params_t*>(bytes.data());
    snd_pcm_uframes_t boundary = 0;
    for (const int fault :
         {alsa_.pcm_sw_params_current(pcm_, p), alsa_.pcm_sw_params_get_boundary(p, &boundary),
          alsa_.pcm_sw_params_set_silence_threshold(pcm_, p, 0),
          alsa_.pcm_sw_params_set_silence_size(pcm_, p, boundary),
          alsa_.pcm_sw_params_set_start_threshold(pcm_, p, periodFrames),
          alsa_.pcm_sw_params_set_stop_threshold(pcm_, p, boundary), alsa_.pcm_sw_params(pcm_, p)})
        if (fault < 0) return fault;
    return 0;
}

void AlsaPcm::begin() {
    if (direction_ == SND_PCM_STREAM_CAPTURE) alsa_.pcm_start(pcm_);
}

// A device that plays on through gaps does not report them. More room than its buffer's size shows a gap.
void AlsaPcm::countGap() noexcept {
    const auto room = alsa_.pcm_avail_update(pcm_);
    const bool isLate = room > 0 && static_cast<snd_pcm_uframes_t>(room) > bufferFrames_;
    if (isLate && !isLate_) ++xruns_;
    isLate_ = isLate;
}

AlsaPcm::Moved AlsaPcm::move(float* samples, int frames, int& done) noexcept {
    done = 0;
    if (alsa_.pcm_wait(pcm_, longestWaitMs) == 0) return Moved::none;
    countGap();
    const auto count = static_cast<snd_pcm_uframes_t>(frames);
    const auto moved = direction_ == SND_PCM_STREAM_PLAYBACK ? alsa_.pcm_writei(pcm_, samples, count)
                                                             : alsa_.pcm_readi(pcm_, samples, count);
    if (moved == -EAGAIN) return Moved::none;
    if (moved >= 0) return done = static_cast<int>(moved), Moved::some;
    if (moved == -EPIPE) ++xruns_;
    if (alsa_.pcm_recover(pcm_, static_cast<int>(moved), 1) < 0) return Moved::failed;
    begin();
    return Moved::none;
}

// Loads all of ALSA's functions, or none.

const AlsaLibrary* alsaLibrary() {
    static const std::optional<AlsaLibrary> loaded = loadAlsa();
    return loaded ? &*loaded : nullptr;
}

AlsaDevice::AlsaDevice(const AlsaLibrary& alsa, std::string name, const std::string& outputId,
                       const std::string& inputId)
    : name_{std::move(name)}
    , in_{alsa, inputId, SND_PCM_STREAM_CAPTURE}
    , out_{alsa, outputId, SND_PCM_STREAM_PLAYBACK} {
    if (!inputId.empty()) inputRange_ = in_.pcm.range();
    if (!outputId.empty()) outputRange_ = out_.pcm.range();
}

std::string AlsaDevice::Direction::open(const ChannelSet& wanted, const AlsaRange& range, int& rateHz,
                                        int& blockFrames) {
    active.clear();
    for (const int k : wanted)
        if (pcm.hasName() && (k < range.maxChannels || range.maxChannels == 0)) active.insert(k);
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

void AlsaDevice::Direction::copy(bool isPlayed) noexcept {
    const auto step = static_cast<std::size_t>(pcm.channels());
    auto channel = channels.begin();
    for (const int k : active) {
        float* among = interleaved.data() + k;
        for (float& sample : *channel++) {
            (isPlayed ? *among : sample) = isPlayed ? sample : *among;
            among += step;
        }
    }
}

std::string AlsaDevice::open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                             int blockFrames) {
    close();
    rateHz_ = sampleRateHz > 0 ? sampleRateHz : std::max(outputRange_.rateHz, inputRange_.rateHz);
    blockFrames_ = blockFrames > 0 ? blockFrames : defaultBlockFrames();
    std::string error = out_.open(outputs, outputRange_, rateHz_, blockFrames_);
    const int playedRateHz = rateHz_;
    if (error.empty()) error = in_.open(inputs, inputRange_, rateHz_, blockFrames_);
    if (error.empty() && !out_.pcm.isOpen())
        error = "expected an output of the device, found none of those wanted";
    if (error.empty() && playedRateHz != rateHz_)
        error = "its inputs run at " + std::to_string(rateHz_) + " Hz, its outputs at " +
                std::to_string(playedRateHz) + " Hz; expected one rate";
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
    if (thread_.joinable()) thread_.join(); // it waits for the device for at most 100 ms at a time
    in_.pcm.close();
    out_.pcm.close();
}

void AlsaDevice::start(DeviceUser& user) {
    if (isOpen()) slot_.begin(*this, user);
}

void AlsaDevice::stop() {
    if (DeviceUser* const user = slot_.end()) user->stopped();
}

// Transfers one whole block. False: the device is being closed, or has gone.
bool AlsaDevice::moveAll(Direction& direction) noexcept {
    const auto step = static_cast<std::size_t>(direction.pcm.channels());
    for (int moved = 0, done = 0; moved < blockFrames_; moved += done) {
        float* const at = direction.interleaved.data() + static_cast<std::size_t>(moved) * step;
        if (direction.pcm.move(at, blockFrames_ - moved, done) == AlsaPcm::Moved::failed) hasFailed_ = true;
        if (isEnding_ || hasFailed_) return false;
    }
    return true;
}

void AlsaDevice::run() noexcept {
    raiseThreadPriority(true);
    const int inputs = static_cast<int>(in_.active.size()), outputs = static_cast<int>(out_.active.size());
    if (inputs > 0) in_.pcm.begin();
    while (!isEnding_) {
        if (inputs > 0 && !moveAll(in_)) return;
        in_.copy(false);
        slot_.call([&](DeviceUser* user) {
            if (user != nullptr)
                user->block(in_.buffers.data(), inputs, out_.buffers.data(), outputs, blockFrames_);
            else
                for (auto& channel : out_.channels) std::ranges::fill(channel, 0.0f);
        });
        out_.copy(true);
        if (!moveAll(out_)) return;
    }
}

// Reads ALSA's list of devices.

std::string AlsaDriver::hintText(const void* hint, const char* kind) const {
    char* const text = alsa_.device_name_get_hint(hint, kind);
    std::string found = text != nullptr ? text : "";
    std::free(text);
    return found;
}

std::string AlsaDriver::configText(snd_config_t* node) const {
    const char* text = nullptr;
    return alsa_.config_get_string(node, &text) >= 0 && text != nullptr ? text : "";
}

// A plug-in names the next one, or has its definition inside of its own.
std::string AlsaDriver::endOf(const std::string& id, int mostPlugins) const {
    snd_config_t *all = nullptr, *definition = nullptr;
    if (mostPlugins < 1 || alsa_.config_update_ref(&all) < 0) return {};
    std::string end, next;
    if (alsa_.config_search_definition(all, "pcm", id.c_str(), &definition) >= 0) {
        const auto in = [this](snd_config_t* node, std::initializer_list<const char*> keys) {
            snd_config_t* found = nullptr;
            for (const char* key : keys)
                if (found == nullptr && alsa_.config_search(node, key, &found) < 0) found = nullptr;
            return found;
        };
        for (auto* node = definition; node != nullptr && next.empty();) {
            if (auto* const type = in(node, {"type"})) end = configText(type);
            node = in(node, {"slave.pcm", "playback.pcm", "slave"});
            if (node != nullptr) next = configText(node);
        }
        alsa_.config_delete(definition);
    }
    alsa_.config_unref(all);
    const std::string further = next.empty() ? std::string{} : endOf(next, mostPlugins - 1);
    return further.empty() ? end : further;
}

void AlsaDriver::addHint(const void* hint) {
    const std::string id = hintText(hint, "NAME"), direction = hintText(hint, "IOID");
    if (isLeftOut(id)) return;
    const std::string end = endOf(id);
    if (end == "jack") return;
    std::string name = inOneLine(hintText(hint, "DESC"));
    if (name.empty()) name = id;
    // ALSA reports both directions for dmix and dsnoop, but each has only one.
    if (direction != "Output" && !id.starts_with("dmix")) inputs_.push_back({id, name, end});
    if (direction != "Input" && !id.starts_with("dsnoop")) outputs_.push_back({id, name, end});
}

void AlsaDriver::addUnlisted(const std::string& id, const std::string& name) {
    if (std::ranges::find(outputs_, id, &Listed::id) != outputs_.end()) return;
    const std::string end = endOf(id);
    if (end == "jack") return;
    const auto offers = [&](snd_pcm_stream_t direction) {
        const AlsaRange range = AlsaPcm{alsa_, id, direction}.range();
        return range.maxChannels > 0 && range.rateHz > 0;
    };
    if (offers(SND_PCM_STREAM_PLAYBACK)) outputs_.push_back({id, name + " output", end});
    if (offers(SND_PCM_STREAM_CAPTURE)) inputs_.push_back({id, name + " input", end});
}

void AlsaDriver::scan() {
    inputs_.clear();
    outputs_.clear();
    void** hints = nullptr;
    if (alsa_.device_name_hint(-1, "pcm", &hints) == 0) {
        for (void** hint = hints; *hint != nullptr; ++hint) addHint(*hint);
        alsa_.device_name_free_hint(hints);
    }
    addUnlisted("default", "Default ALSA");
    addUnlisted("pulse", "Pulseaudio");
    for (List* list : {&inputs_, &outputs_}) {
        const auto rank = [](const Listed& l) { return l.id == "default" ? 0 : l.id == "pulse" ? 1 : 2; };
        std::ranges::stable_sort(*list, {}, rank);
        std::map<std::string, int> total, seen;
        for (const Listed& l : *list) ++total[l.name];
        for (Listed& l : *list)
            if (const std::string name = l.name; total[name] > 1)
                l.name += " (" + std::to_string(++seen[name]) + ")";
    }
}

std::vector<std::string> AlsaDriver::deviceNames(bool inputs) {
    std::vector<std::string> names;
    const bool withPulse = !isJackThere_();
    for (const Listed& l : inputs ? inputs_ : outputs_)
        if (withPulse || l.end != "pulse") names.push_back(l.name);
    return names;
}

std::string AlsaDriver::idOf(const List& list, const std::string& name) {
    const auto at = std::ranges::find(list, name, &Listed::name);
    return at != list.end() ? at->id : "";
}

std::unique_ptr<AudioDevice> AlsaDriver::create(const std::string& name, bool withInputs) {
    const std::string id = idOf(outputs_, name);
    if (id.empty()) return nullptr;
    auto device = std::make_unique<AlsaDevice>(alsa_, name, id, withInputs ? idOf(inputs_, name) : "");
    return device->isThere() ? std::move(device) : nullptr;
}

} // namespace physvib
