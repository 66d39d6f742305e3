// SPDX-License-Identifier: MIT
// Raw HID devices of Linux, sources of reports for them (HidFeed), and a sink that finds a controller and
// sends it the reports of a feed while an audio device plays.
#pragma once
#include "Io/Result.h"
#include "Live/Pads/GamePads.h"
#include "Live/Pads/PadReports.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Sink.h"
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace physvib {

// Controllers as Linux lists them for raw reports (/sys/class/hidraw), and writing such reports.

/// A model of controller, as it identifies itself.
struct HidModel {
    std::uint16_t vendor, product;
    PadBus bus; ///< other: any
};

struct HidNode {
    std::filesystem::path path; ///< "/dev/hidraw3"
    std::string name;           ///< as the controller reports it
    PadBus bus = PadBus::other;
};

/// The folders in which the system lists such devices. For tests, PHYSVIB_HIDRAW=FOLDER replaces both by
/// FOLDER/class and FOLDER/dev.
struct HidFolders {
    std::filesystem::path classes = "/sys/class/hidraw", nodes = "/dev";
    static HidFolders systemFolders();
};

/// An open controller, exclusive within the process; only for writing. One thread at a time.
class HidDevice {
public:
    /// Connected controllers of these models, sorted by node. Empty where the system has no such list. Any
    /// thread but the render thread (R), as all functions here.
    static std::vector<HidNode> list(std::span<const HidModel> models,
                                     const HidFolders& folders = HidFolders::systemFolders());

    /// Opens the first one whose name or node contains `name` (ignoring case; anyPad: any) and that this
    /// process has not opened. An error if there is none, or this user may not write to it.
    static Result<std::unique_ptr<HidDevice>> open(std::span<const HidModel> models, const std::string& name,
                                                   const HidFolders& folders = HidFolders::systemFolders());
    ~HidDevice();
    HidDevice(const HidDevice&) = delete;
    HidDevice& operator=(const HidDevice&) = delete;

    const HidNode& hidNode() const noexcept { return hidNode_; }
    /// Sends one whole report, its number first; may wait for the system. False: the controller has gone.
    bool write(std::span<const std::uint8_t> report);

private:
    HidDevice(HidNode hidNode, std::FILE* file)
        : hidNode_{std::move(hidNode)}
        , file_{file} {}
    HidNode hidNode_;
    std::FILE* file_;
};

// Sources of reports: a session's samples, or its events as tones.

/// Which controllers a feed is for, and how they are called.
struct HidFeedKind {
    std::span<const HidModel> models;
    std::string_view name; ///< "DualSense by Bluetooth"
};

inline constexpr int silentReportCount = 5; ///< as many as Linux' own driver sends to Switch controllers

/// Makes the reports of one controller. Methods without a remark run on the controller's thread.
class HidFeed {
public:
    virtual ~HidFeed() = default;
    virtual const HidFeedKind& kind() const noexcept = 0;

    /// Render thread (R), wait-free.
    virtual void onBlock(const RenderedBlock&) noexcept PHYSVIB_NONBLOCKING {}
    /// As in Sink: wait-free, on the threads that hold the world mutex and the input mutex.
    virtual void onCollision(const CollisionEvent&) noexcept {}
    virtual void onControl(const RenderControl&) noexcept {}

    /// A session begins, or time has gone back: what was fed before is discarded.
    virtual void begin() = 0;
    /// Reports that a controller needs before the first and after the last one, switchSeconds apart.
    virtual std::span<const PadReport> startReports() const noexcept { return {}; }
    virtual std::span<const PadReport> endReports() const noexcept { return {}; }
    /// The report that is due at that steady time, if one is. `sessionNs`: what is felt now on the device;
    /// `level`: the master level, 0: silent within this report.
    virtual std::optional<PadReport> next(std::int64_t nowNs, std::int64_t sessionNs, float level) = 0;
    /// A report of silence. It is sent `silentReportCount` times, because radio may lose one.
    virtual PadReport silentReport() = 0;
    virtual std::uint64_t lost() const noexcept { return 0; }   ///< frames or events; any thread
    virtual bool playsClips() const noexcept { return true; }   ///< as SinkState
    virtual double leadSeconds() const noexcept { return 0.0; } ///< as Sink::latencySeconds
    virtual double maxDelaySeconds() const noexcept = 0;        ///< longest delay of a report
};

/// Counts of what was sent, for display and tests.
struct HidCounts {
    std::uint64_t reports = 0, connections = 0;
};

/// A thread of its own owns the controller and writes to it without a lock, as a write may take seconds.
/// The message thread (M) waits for it in the destructor, and at most 250 ms for its silence in follow().
class HidOutput final : public Sink {
public:
    /// `name`: anyPad, or part of a controller's name or node. M.
    HidOutput(const std::string& name, std::unique_ptr<HidFeed> feed);
    ~HidOutput() override;

    std::string awaitReady(const std::function<bool()>& keepGoing) override;
    double latencySeconds() const noexcept override { return leadSeconds_; } ///< 0 until it connects
    void follow(OutputClock* device) override;
    void onCollision(const CollisionEvent& event) noexcept override { feed_->onCollision(event); }
    void onControl(const RenderControl& control) noexcept override { feed_->onControl(control); }
    void onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override { feed_->onBlock(block); }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& keepGoing) const override;

    HidCounts counts() const; ///< any thread

private:
    void run();
    void connect();
    std::optional<PadReport> dueReport(std::int64_t nowNs);
    void write(const PadReport& report);
    bool send(const PadReport& report);
    void sendAll(std::span<const PadReport> reports);
    void stopOutput();
    std::string kindName() const { return std::string{feed_->kind().name}; }
    std::string currentError() const;

    const std::string nameFilter_;
    const std::unique_ptr<HidFeed> feed_;

    std::unique_ptr<HidDevice> pad_; // used by the thread alone, as the next two lines
    std::int64_t nextSearchNs_ = 0;  // steady clock
    bool hasStartedOutput_ = false;  // a report has been sent since the output started

    FollowedDevice device_; // its mutex guards the members below, used by the thread and M
    std::string node_;      // node of the controller; empty: none is open
    std::string lastName_, openError_{"none is there"};
    HidCounts counts_;

    std::atomic<double> leadSeconds_{0.0};
    std::atomic<bool> isStopping_{false};
    std::thread thread_; // last: it uses the other members
};

} // namespace physvib
