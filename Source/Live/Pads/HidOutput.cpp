// SPDX-License-Identifier: MIT
// The thread that finds a controller, follows the device's clock and writes the reports that are due.
#include "Live/Pads/HidOutput.h"
#include "Io/Text/NumberText.h"
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <set>

namespace physvib {

// Reads the list of raw devices, and writes reports without a buffer, so that one call is one report.

namespace {

std::mutex openedMutex;
std::set<std::filesystem::path> opened; // nodes opened by this process; guarded by openedMutex

/// "HID_ID=0005:0000054C:00000CE6": bus, vendor, product.
bool isOneOf(std::span<const HidModel> models, const std::string& id, PadBus& bus) {
    unsigned number = 0, vendor = 0, product = 0;
    if (std::sscanf(id.c_str(), "%x:%x:%x", &number, &vendor, &product) != 3) return false;
    bus = number == 0x03 ? PadBus::usb : number == 0x05 ? PadBus::bluetooth : PadBus::other;
    return std::ranges::any_of(models, [&](const HidModel& model) {
        return model.vendor == vendor && model.product == product &&
               (model.bus == PadBus::other || model.bus == bus);
    });
}

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t lookNs = 250 * msNs; // search interval for a newly connected controller
constexpr std::int64_t patienceNs = 500 * msNs;

} // namespace

HidFolders HidFolders::ofSystem() {
    if (const char* folder = std::getenv("PHYSVIB_HIDRAW"))
        return {std::filesystem::path{folder} / "class", std::filesystem::path{folder} / "dev"};
    return {};
}

std::vector<HidPlace> HidDevice::list(std::span<const HidModel> models, const HidFolders& folders) {
    std::vector<HidPlace> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator{folders.classes, ignored}) {
        HidPlace place{folders.nodes / entry.path().filename(), {}, {}};
        std::ifstream file{entry.path() / "device" / "uevent"};
        bool isModel = false;
        for (std::string line; std::getline(file, line);) {
            const auto at = line.find('=');
            if (at == line.npos) continue;
            const std::string value = line.substr(at + 1);
            if (line.starts_with("HID_ID=")) isModel = isOneOf(models, value, place.bus);
            if (line.starts_with("HID_NAME=")) place.name = value;
        }
        if (isModel) found.push_back(std::move(place));
    }
    std::ranges::sort(found, {}, &HidPlace::node);
    return found;
}

Result<std::unique_ptr<HidDevice>> HidDevice::open(std::span<const HidModel> models, const std::string& where,
                                                   const HidFolders& folders) {
    std::string refused;
    const std::lock_guard lock{openedMutex};
    for (HidPlace& place : list(models, folders)) {
        const std::string node = place.node.string();
        if (where != anyPad && lowerCase(place.name + " " + node).find(lowerCase(where)) == std::string::npos)
            continue;
        if (opened.contains(place.node)) continue;
        if (std::FILE* const file = std::fopen(node.c_str(), "r+b")) {
            std::setvbuf(file, nullptr, _IONBF, 0);
            opened.insert(place.node);
            return std::unique_ptr<HidDevice>{new HidDevice{std::move(place), file}};
        }
        const bool isForbidden = errno == EACCES || errno == EPERM;
        refused = place.name +
                  (isForbidden ? ": this user may not write to " + node +
                                     "; install PhysVib's rule for udev and connect it again (Docs/pads.md)"
                               : ": " + node + " cannot be opened");
    }
    return Failure{refused.empty() ? "none is there" : refused};
}

HidDevice::~HidDevice() {
    std::fclose(file_);
    const std::lock_guard lock{openedMutex};
    opened.erase(place_.node);
}

bool HidDevice::write(std::span<const std::uint8_t> report) {
    std::error_code ignored;
    return std::filesystem::exists(place_.node, ignored) &&
           std::fwrite(report.data(), 1, report.size(), file_) == report.size();
}

HidOutput::HidOutput(const std::string& where, std::unique_ptr<HidFeed> feed)
    : where_{where.empty() ? anyPad : where}
    , feed_{std::move(feed)}
    , thread_{[this] { run(); }} {}

HidOutput::~HidOutput() {
    follow(nullptr);
    stop_ = true;
    thread_.join();
}

std::string HidOutput::awaitReady(const std::function<bool()>& keepGoing) {
    return device_.await(
        patienceNs, keepGoing, [this] { return !node_.empty(); }, [this] { return troubleNow(); });
}

void HidOutput::follow(OutputClock* device) {
    device_.follow(
        device, [] {}, [] { return false; }); // the first report of silence is written within 20 ms
}

void HidOutput::run() {
    for (; !stop_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
        connect();
        device_.beginAnew([this] { rest(); }, [this] { feed_->begin(); });
        if (const auto report = due(steadyNs())) write(*report);
    }
    rest();
}

void HidOutput::connect() {
    const std::int64_t nowNs = steadyNs();
    if (pad_ || nowNs < looksNs_) return;
    looksNs_ = nowNs + lookNs;
    auto found = HidDevice::open(feed_->kind().models, where_);
    const std::lock_guard lock{device_.mutex};
    refusal_ = found.error;
    if (!found) return;
    pad_ = std::move(found.value);
    hasSent_ = false;
    node_ = pad_->place().node.string();
    lastName_ = pad_->place().name;
    leadSeconds_ = feed_->leadSeconds();
    ++counts_.connections;
}

std::optional<PadReport> HidOutput::due(std::int64_t nowNs) {
    const std::lock_guard lock{device_.mutex};
    const auto sessionNs = device_.sessionNs(nowNs, [this] { feed_->begin(); });
    return sessionNs ? feed_->next(nowNs, *sessionNs, device_.level()) : std::nullopt;
}

void HidOutput::write(const PadReport& report) {
    if (!pad_) return;
    if (!hasSent_) sendAll(feed_->on());
    hasSent_ = true;
    if (!send(report)) return;
    const std::lock_guard lock{device_.mutex};
    ++counts_.reports;
}

bool HidOutput::send(const PadReport& report) {
    if (pad_ && !pad_->write(report.span())) {
        pad_.reset();
        const std::lock_guard lock{device_.mutex};
        node_.clear();
    }
    return pad_ != nullptr;
}

void HidOutput::sendAll(std::span<const PadReport> reports) {
    for (const PadReport& report : reports) {
        send(report);
        std::this_thread::sleep_for(std::chrono::duration<double>{switchSeconds});
    }
}

void HidOutput::rest() {
    if (!pad_ || !hasSent_) return;
    for (int i = 0; i < silentReports && send(feed_->rest()); ++i)
        std::this_thread::sleep_for(std::chrono::duration<double>{switchSeconds});
    sendAll(feed_->off());
    hasSent_ = false;
}

std::string HidOutput::troubleNow() const {
    if (!node_.empty()) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    if (refusal_ == "none is there")
        return where_ == anyPad ? "no " + label() + " is there"
                                : "no " + label() + " is called " + inQuotes(where_);
    return refusal_;
}

HidCounts HidOutput::counts() const {
    const std::lock_guard lock{device_.mutex};
    return counts_;
}

SinkState HidOutput::state() const {
    const std::lock_guard lock{device_.mutex};
    SinkState state;
    state.name = "controller";
    state.isReady = !node_.empty();
    state.sent = counts_.reports;
    state.lost = feed_->lost();
    state.playsClips = feed_->playsClips();
    state.trouble = troubleNow();
    state.where = state.isReady ? label() + ", " + node_ + ": up to " +
                                      fixedNumber(1e3 * feed_->laterSeconds(), 0) + " ms after the device"
                                : state.trouble;
    state.facts = {{"Controller", state.where, !state.isReady},
                   {"Reports", std::to_string(counts_.reports), false}};
    return state;
}

std::string HidOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{device_.mutex};
    std::string line = (lastName_.empty() ? label() : lastName_) + ": " + std::to_string(counts_.reports) +
                       " reports, " + std::to_string(feed_->lost()) + " lost";
    if (counts_.connections > 1) line += "; connected " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
