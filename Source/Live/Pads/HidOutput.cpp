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

std::mutex openNodesMutex;
std::set<std::filesystem::path> openNodes; // nodes opened by this process; guarded by openNodesMutex

/// "HID_ID=0005:0000054C:00000CE6": bus, vendor, product.
bool matchesModel(std::span<const HidModel> models, const std::string& id, PadBus& bus) {
    unsigned number = 0, vendor = 0, product = 0;
    if (std::sscanf(id.c_str(), "%x:%x:%x", &number, &vendor, &product) != 3) return false;
    bus = number == 0x03 ? PadBus::usb : number == 0x05 ? PadBus::bluetooth : PadBus::other;
    return std::ranges::any_of(models, [&](const HidModel& model) {
        return model.vendor == vendor && model.product == product &&
               (model.bus == PadBus::other || model.bus == bus);
    });
}

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t searchIntervalNs = 250 * msNs; // search interval for a newly connected controller
constexpr std::int64_t timeOutNs = 500 * msNs;

} // namespace

HidFolders HidFolders::systemFolders() {
    if (const char* folder = std::getenv("PHYSVIB_HIDRAW"))
        return {std::filesystem::path{folder} / "class", std::filesystem::path{folder} / "dev"};
    return {};
}

std::vector<HidNode> HidDevice::list(std::span<const HidModel> models, const HidFolders& folders) {
    std::vector<HidNode> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator{folders.classes, ignored}) {
        HidNode hidNode{folders.nodes / entry.path().filename(), {}, {}};
        std::ifstream file{entry.path() / "device" / "uevent"};
        bool isModel = false;
        for (std::string line; std::getline(file, line);) {
            const auto separator = line.find('=');
            if (separator == line.npos) continue;
            const std::string value = line.substr(separator + 1);
            if (line.starts_with("HID_ID=")) isModel = matchesModel(models, value, hidNode.bus);
            if (line.starts_with("HID_NAME=")) hidNode.name = value;
        }
        if (isModel) found.push_back(std::move(hidNode));
    }
    std::ranges::sort(found, {}, &HidNode::path);
    return found;
}

Result<std::unique_ptr<HidDevice>> HidDevice::open(std::span<const HidModel> models, const std::string& name,
                                                   const HidFolders& folders) {
    std::string openError;
    const std::lock_guard lock{openNodesMutex};
    for (HidNode& hidNode : list(models, folders)) {
        const std::string node = hidNode.path.string();
        if (name != anyPad && lowerCase(hidNode.name + " " + node).find(lowerCase(name)) == std::string::npos)
            continue;
        if (openNodes.contains(hidNode.path)) continue;
        if (std::FILE* const file = std::fopen(node.c_str(), "r+b")) {
            std::setvbuf(file, nullptr, _IONBF, 0);
            openNodes.insert(hidNode.path);
            return std::unique_ptr<HidDevice>{new HidDevice{std::move(hidNode), file}};
        }
        const bool isForbidden = errno == EACCES || errno == EPERM;
        openError = hidNode.name +
                    (isForbidden ? ": this user may not write to " + node +
                                       "; install PhysVib's rule for udev and connect it again (Docs/pads.md)"
                                 : ": " + node + " cannot be opened");
    }
    return Failure{openError.empty() ? "none is there" : openError};
}

HidDevice::~HidDevice() {
    std::fclose(file_);
    const std::lock_guard lock{openNodesMutex};
    openNodes.erase(hidNode_.path);
}

bool HidDevice::write(std::span<const std::uint8_t> report) {
    std::error_code ignored;
    return std::filesystem::exists(hidNode_.path, ignored) &&
           std::fwrite(report.data(), 1, report.size(), file_) == report.size();
}

HidOutput::HidOutput(const std::string& name, std::unique_ptr<HidFeed> feed)
    : nameFilter_{name.empty() ? anyPad : name}
    , feed_{std::move(feed)}
    , thread_{[this] { run(); }} {}

HidOutput::~HidOutput() {
    follow(nullptr);
    isStopping_ = true;
    thread_.join();
}

std::string HidOutput::awaitReady(const std::function<bool()>& keepGoing) {
    return device_.await(
        timeOutNs, keepGoing, [this] { return !node_.empty(); }, [this] { return currentError(); });
}

void HidOutput::follow(OutputClock* device) {
    device_.follow(
        device, [] {}, [] { return false; }); // the first report of silence is written within 20 ms
}

void HidOutput::run() {
    for (; !isStopping_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
        connect();
        device_.restartIfChanged([this] { stopOutput(); }, [this] { feed_->begin(); });
        if (const auto report = dueReport(steadyNs())) write(*report);
    }
    stopOutput();
}

void HidOutput::connect() {
    const std::int64_t nowNs = steadyNs();
    if (pad_ || nowNs < nextSearchNs_) return;
    nextSearchNs_ = nowNs + searchIntervalNs;
    auto found = HidDevice::open(feed_->kind().models, nameFilter_);
    const std::lock_guard lock{device_.mutex};
    openError_ = found.error;
    if (!found) return;
    pad_ = std::move(found.value);
    hasStartedOutput_ = false;
    node_ = pad_->hidNode().path.string();
    lastName_ = pad_->hidNode().name;
    leadSeconds_ = feed_->leadSeconds();
    ++counts_.connections;
}

std::optional<PadReport> HidOutput::dueReport(std::int64_t nowNs) {
    const std::lock_guard lock{device_.mutex};
    const auto sessionNs = device_.sessionNs(nowNs, [this] { feed_->begin(); });
    return sessionNs ? feed_->next(nowNs, *sessionNs, device_.level()) : std::nullopt;
}

void HidOutput::write(const PadReport& report) {
    if (!pad_) return;
    if (!hasStartedOutput_) sendAll(feed_->startReports());
    hasStartedOutput_ = true;
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

void HidOutput::stopOutput() {
    if (!pad_ || !hasStartedOutput_) return;
    for (int i = 0; i < silentReportCount && send(feed_->silentReport()); ++i)
        std::this_thread::sleep_for(std::chrono::duration<double>{switchSeconds});
    sendAll(feed_->endReports());
    hasStartedOutput_ = false;
}

std::string HidOutput::currentError() const {
    if (!node_.empty()) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    if (openError_ == "none is there")
        return nameFilter_ == anyPad ? "no " + kindName() + " is there"
                                     : "no " + kindName() + " is called " + inQuotes(nameFilter_);
    return openError_;
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
    state.error = currentError();
    state.label = state.isReady ? kindName() + ", " + node_ + ": up to " +
                                      fixedNumber(1e3 * feed_->maxDelaySeconds(), 0) + " ms after the device"
                                : state.error;
    state.details = {{"Controller", state.label, !state.isReady},
                     {"Reports", std::to_string(counts_.reports), false}};
    return state;
}

std::string HidOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{device_.mutex};
    std::string line = (lastName_.empty() ? kindName() : lastName_) + ": " + std::to_string(counts_.reports) +
                       " reports, " + std::to_string(feed_->lost()) + " lost";
    if (counts_.connections > 1) line += "; connected " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
