// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of the device, its sinks, monitor and triggers, and OSC, with their status.
#include "Mixer/Output/OutputTab.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {
namespace {

constexpr std::array<int, 6> sampleRatesHz{8000, 44100, 48000, 88200, 96000, 192000};
constexpr std::array<int, 7> blockSizes{32, 64, 128, 256, 512, 1024, 2048};
constexpr std::array<int, 9> monitorLevelsDb{0, -5, -10, -15, -20, -25, -30, -40, -50};
constexpr int noneId = 1, zeroDbId = 100; // item ids: noneId + 1 + output, zeroDbId - level in dB
constexpr int firstSinkId = 1000;         // item ids of the list of outputs: behind those of devices

struct Cell {
    juce::Label& name;
    juce::Component& box;
};

/// Places names and boxes in columns of one width, from the top of `area`, which is reduced.
void placeGrid(juce::Rectangle<int>& area, const std::vector<Cell>& cells) {
    constexpr int columns = 3;
    const int columnWidth = (area.getWidth() - (columns - 1) * gap) / columns;
    juce::Rectangle<int> names, row;
    for (int k = 0; const Cell& cell : cells) {
        if (k++ % columns == 0)
            names = area.removeFromTop(OutputTab::cellTitleHeight).withTrimmedTop(10),
            row = area.removeFromTop(rowHeight);
        cell.name.setBounds(names.removeFromLeft(columnWidth));
        cell.box.setBounds(row.removeFromLeft(columnWidth));
        names.removeFromLeft(gap);
        row.removeFromLeft(gap);
    }
}

// who may send OSC messages, in the order of OscAccess
constexpr std::array<const char*, 3> oscAccessLabels{"nobody", "this computer", "phones too"};
struct PhoneOrientation {
    const char* label;
    double phoneTurnDegrees;
};
// how a phone is held, by the direction in which its top edge points
constexpr std::array<PhoneOrientation, 4> phoneOrientations{
    {{"up", 0.0}, {"left", 90.0}, {"down", 180.0}, {"right", -90.0}}};
constexpr int nobodyId = 1, lastReceiverId = 2, otherReceiverId = 3; // item ids of the list of receivers

/// The address with 0.0.0.0 replaced by those at which others reach this computer.
juce::String reachableAddress(const std::string& address) {
    const auto text = utf8(address), port = text.fromLastOccurrenceOf(":", true, false);
    if (!text.startsWith("0.0.0.0")) return text;
    juce::StringArray all;
    for (const auto& local : localAddresses()) all.add(utf8(local) + port);
    return all.isEmpty() ? text : all.joinIntoString(" or ");
}

} // namespace

OutputTab::OutputTab(MixerModel& model)
    : model_{model} {
    setTitle("Output");
    describe(monitor_, "Monitor",
             "Two outputs, left and right: each hit is heard where it is felt, also without actuators");
    describe(monitorLevel_, "Level of the monitor",
             "What a hit at full scale reaches; the master level leaves it alone. Start low");
    describe(marker_, "Marks",
             "A pulse at the sample of each onset, for trigger boxes. No actuator and no ear belongs there");
    for (const int db : monitorLevelsDb) monitorLevel_.addItem(number(db, 0) + " dBFS", zeroDbId - db);
    for (auto* box : {&monitor_, &monitorLevel_}) box->onChange = [this] { chooseMonitor(); };
    marker_.onChange = [this] {
        model_.reportIfError(model_.device().listening().setMarker(marker_.getSelectedId() - noneId - 1));
        fillMonitorLists();
    };
    describe(osc_, "OSC", "Who may strike, tilt and set gains by messages over the network: phones, Pd, Max");
    for (int access = 0; access < static_cast<int>(oscAccessLabels.size()); ++access)
        osc_.addItem(nth(oscAccessLabels, access), access + 1);
    describe(receiver_, "Hits by OSC",
             "HOST:PORT of a program that hears of each hit as it is felt, and of the status once a second");
    describe(phone_, "Phone", "How a phone is held that tilts the world by OSC: where its top points");
    for (int k = 0; k < static_cast<int>(phoneOrientations.size()); ++k)
        phone_.addItem(nth(phoneOrientations, k).label, k + 1);
    for (auto* box : {&osc_, &phone_}) box->onChange = [this] { applyOsc(); };
    receiver_.onChange = [this] { chooseReceiver(); };
    device_.setTitle("Device");
    rate_.setTitle("Rate");
    block_.setTitle("Block");
    rate_.addItem("default", 1);
    for (const int hz : sampleRatesHz) rate_.addItem(juce::String{hz} + " Hz", hz);
    block_.addItem("default", 1);
    for (const int frames : blockSizes) block_.addItem(juce::String{frames}, frames);
    scan_ = makeLinkButton("Rescan", "Rescan devices", [this] { scan(); });
    for (auto* box : {&device_, &rate_, &block_}) box->onChange = [this] { open(); };
    addAll(*this, {&deviceLabel_,       &device_,       scan_.get(),   &rateLabel_,    &rate_,
                   &blockLabel_,        &block_,        &oscLabel_,    &osc_,          &receiverLabel_,
                   &receiver_,          &phoneLabel_,   &phone_,       &monitorLabel_, &monitor_,
                   &monitorLevelLabel_, &monitorLevel_, &markerLabel_, &marker_,       &statusTable_});
    mixChanged();
}

void OutputTab::scan() {
    devices_ = listAudioDevices(model_.device().drivers());
    findSinks();
    isScanned_ = true;
    mixChanged();
}

void OutputTab::findSinks() {
    sinks_.clear();
    for (const SinkKind& kind : sinkKinds()) sinks_.push_back(kind.listUnits());
}

// Adds to the list the sinks that can play beside the device; missing ones are grey and say why.
void OutputTab::listSinks() {
    sinkRows_.clear();
    device_.addSectionHeading("Beside it");
    const auto add = [this](const SinkKind& kind, const std::string& address, const juce::String& label,
                            bool isAvailable, bool isInUse) {
        juce::PopupMenu::Item item{juce::String{kind.title.data()} + ": " + label +
                                   (isInUse ? ", in use" : "")};
        item.itemID = firstSinkId + static_cast<int>(sinkRows_.size());
        if (!isAvailable) item.colour = shade(*this, Shade::muted);
        device_.getRootMenu()->addItem(item);
        sinkRows_.push_back({kind, address, isAvailable, isInUse});
    };
    sinks_.resize(sinkKinds().size());
    for (std::size_t k = 0; k < sinks_.size(); ++k) {
        const SinkKind& kind = sinkKinds()[k];
        const auto address = model_.device().choice().sinkAddress(kind);
        bool isMissing = !address.empty();
        for (const SinkUnit& unit : sinks_[k]) {
            const bool isInUse = isMissing && (address == unit.address || address == kind.anyAddress);
            add(kind, unit.address,
                utf8(unit.address) + (unit.label.empty() ? juce::String{} : "  " + utf8(unit.label)), true,
                isInUse);
            isMissing = isMissing && !isInUse;
        }
        if (isMissing)
            add(kind, address,
                (address == kind.anyAddress ? "none" : utf8(address) + " is not") + " there yet", false,
                true);
        else if (sinks_[k].empty())
            add(kind, std::string{kind.anyAddress}, "none is plugged in", false, false);
        if (!kind.otherTitle.empty())
            add(kind, {}, "another " + juce::String{kind.otherTitle.data()}.toLowerCase() + ellipsis(), true,
                false);
    }
}

void OutputTab::chooseSink(const SinkRow& row) {
    const SinkKind& kind = row.kind;
    if (row.isInUse) return setSink(kind, {});
    if (row.address.empty())
        return askForText(
            kind.title.data(), kind.otherTitle.data(), utf8(model_.device().choice().sinkAddress(kind)),
            [this, &kind](const juce::String& address) { setSink(kind, address.toStdString()); });
    if (row.isAvailable) return setSink(kind, row.address);
    model_.messages().show(
        {juce::String{kind.title.data()} + ": none is plugged in. " + kind.tooltip.data(),
         true,
         {"Use it once it is there", [this, &kind] { setSink(kind, std::string{kind.anyAddress}); }},
         "absent"});
}

void OutputTab::setSink(const SinkKind& kind, const std::string& address) {
    DeviceChoice choice = model_.device().choice();
    if (choice.sinkAddress(kind) == address || !model_.device().onSinksRequested) return;
    choice.setSink(kind, address);
    model_.device().onSinksRequested(choice);
}

void OutputTab::open() {
    if (const auto row = device_.getSelectedId() - firstSinkId; row >= 0) {
        const SinkRow chosenRow = nth(sinkRows_, row);
        mixChanged(); // shows the unchanged choice: the user may yet cancel
        return chooseSink(chosenRow);
    }
    const int index = device_.getSelectedId() - 1;
    DeviceChoice choice = model_.device().choice();
    if (index >= 0 && index < static_cast<int>(devices_.size()))
        choice.name = nth(devices_, index).type + ":" + nth(devices_, index).name;
    const bool wasHeadphones = choice.isHeadphones;
    if (index >= 0) choice.isHeadphones = index == static_cast<int>(devices_.size()); // the last item
    if (choice.isHeadphones) choice.name = headphoneDevice_;
    choice.sampleRateHz = rate_.getSelectedId() > 1 ? rate_.getSelectedId() : 0;
    choice.blockFrames = block_.getSelectedId() > 1 ? block_.getSelectedId() : 0;
    choice.isHeadphones && !wasHeadphones ? openHeadphones(model_, choice) : model_.open(choice);
    mixChanged();
}

juce::String OutputTab::actuatorLabelsAt(int output, bool marksMuted) const {
    const auto& mix = model_.mix();
    juce::String ownerLabels;
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (mix.strips[j].output == output)
            ownerLabels << " " << labelOf(mix, j)
                        << (marksMuted && mix.isSilent(static_cast<int>(j)) ? " (muted)" : "");
    return ownerLabels;
}

// Lists output pairs for headphones, with the labels of actuators that would lose their output.
void OutputTab::fillMonitorLists() {
    const auto& choice = model_.device().choice();
    monitor_.clear(dontNotify);
    marker_.clear(dontNotify);
    monitor_.addItem("none", noneId);
    marker_.addItem("none", noneId);
    for (int k = 0; k < model_.device().outputCount(); ++k) {
        if (actuatorLabelsAt(k).isEmpty()) marker_.addItem("output " + juce::String{k + 1}, noneId + 1 + k);
        if (k % 2 != 0 || k + 1 >= model_.device().outputCount()) continue;
        const auto ownerLabels = actuatorLabelsAt(k) + actuatorLabelsAt(k + 1);
        monitor_.addItem(juce::String{k + 1} + " and " + juce::String{k + 2} +
                             (ownerLabels.isEmpty() ? juce::String{} : ", instead of" + ownerLabels),
                         noneId + 1 + k);
    }
    monitor_.setSelectedId(choice.monitorOutputs.empty() ? noneId : noneId + 1 + choice.monitorOutputs[0],
                           dontNotify);
    if (choice.monitorOutputs.size() == 2 && model_.device().listening().settings().contacts.empty()) {
        const auto ownerLabels =
            actuatorLabelsAt(choice.monitorOutputs[0]) + actuatorLabelsAt(choice.monitorOutputs[1]);
        monitor_.setText("off: outputs " + juce::String{choice.monitorOutputs[0] + 1} + " and " +
                             juce::String{choice.monitorOutputs[1] + 1} +
                             (ownerLabels.isEmpty() ? juce::String{} : ", which are of" + ownerLabels),
                         dontNotify);
    }
    monitorLevel_.setEnabled(monitor_.getSelectedId() != 0); // a level is of the outputs that are shown
    monitorLevel_.setSelectedId(zeroDbId - juce::roundToInt(choice.monitorDb), dontNotify);
    if (monitorLevel_.getSelectedId() == 0)
        monitorLevel_.setText(number(choice.monitorDb, 1) + " dBFS", dontNotify);
    marker_.setSelectedId(noneId + 1 + choice.markerOutput, dontNotify);
}

void OutputTab::chooseMonitor() {
    const int left = monitor_.getSelectedId() - noneId - 1;
    const double db = monitorLevel_.getSelectedId() > 0 ? zeroDbId - monitorLevel_.getSelectedId()
                                                        : model_.device().choice().monitorDb;
    model_.reportIfError(left < 0 ? model_.device().listening().setMonitor({}, db)
                                  : model_.moveOutputsToMonitor({left, left + 1}, db));
    fillMonitorLists();
}

juce::String OutputTab::monitorText() const {
    const auto& listening = model_.device().listening().settings();
    juce::String text;
    if (!model_.device().hasNoDevice() && model_.device().outputCount() == 0)
        return "by nobody: the device is not there";
    if (model_.device().choice().isHeadphones)
        for (int ear = 0; ear < DeviceChoice::earCount; ++ear)
            text << (ear == 0 ? "left:" : ", right:")
                 << (actuatorLabelsAt(ear).isEmpty() ? juce::String{" nobody"} : actuatorLabelsAt(ear, true));
    else if (listening.contacts.size() == 2)
        text << "left on " << listening.contacts[0] + 1 << ", right on " << listening.contacts[1] + 1;
    else if (!model_.device().choice().monitorOutputs.empty())
        text << "not there: an actuator, or no output";
    else
        text << "by nobody";
    if (!listening.marks.empty()) text << "; onsets marked on " << listening.marks[0] + 1;
    return text;
}

void OutputTab::askForText(const juce::String& title, const juce::String& field, const juce::String& initial,
                           std::function<void(const juce::String&)> onAccept) {
    askForValues(*this, title, "Connect", {{field, initial}},
                 [onAccept = std::move(onAccept)](const juce::StringArray& values) {
                     if (values[0].isNotEmpty()) onAccept(values[0]);
                 });
}

std::vector<StatusRow> OutputTab::sinkStatusRows() const {
    std::vector<StatusRow> rows;
    for (const SinkState& sink : model_.session().sinks().states()) {
        const bool lacksChannels = sink.isReady && sink.channels > 0 && model_.mix().count() > sink.channels;
        juce::String sinkText = utf8(sink.label);
        if (lacksChannels) sinkText << "; the first " << sink.channels << " actuators";
        rows.push_back({displayTitle(sink.name), sinkText, sink.isReady ? Shade::text : Shade::highlight});
    }
    if (rows.empty()) rows.push_back({"Board", "none", Shade::muted});
    return rows;
}

void OutputTab::mixChanged() {
    const auto& choice = model_.device().choice();
    device_.clear(dontNotify);
    int chosenId = 0;
    const bool isWithoutDevice = choice.name.starts_with(nullDeviceType);
    if (!isWithoutDevice) headphoneDevice_ = choice.name;
    for (int id = 1; const auto& device : devices_) {
        const auto name = device.type + ":" + device.name;
        device_.addItem(device.type == nullDeviceType
                            ? juce::String{noDeviceTitle}
                            : utf8(name) + " (" + juce::String{device.channels} + " outputs)",
                        id);
        if (name == choice.name) chosenId = id;
        if (headphoneDevice_.empty() && device.type != nullDeviceType &&
            device.channels >= DeviceChoice::earCount)
            headphoneDevice_ = name;
        ++id;
    }
    const int headphonesId = static_cast<int>(devices_.size()) + 1;
    if (!headphoneDevice_.empty())
        device_.addItem("Headphones: " + utf8(headphoneDevice_) + " (L and R)", headphonesId);
    if (choice.isHeadphones && !isWithoutDevice) chosenId = headphonesId;
    listSinks();
    device_.setSelectedId(chosenId, dontNotify);
    auto title = !isWithoutDevice ? (chosenId > 0 ? device_.getText() : utf8(choice.name))
                                  : juce::String{choice.sinks.empty() ? noDeviceTitle : "No device"};
    for (const SinkName& sink : choice.sinks) title << " + " << findSinkKind(sink).title.data();
    device_.setText(title, dontNotify);
    rate_.setSelectedId(choice.sampleRateHz > 0 ? choice.sampleRateHz : 1, dontNotify);
    block_.setSelectedId(choice.blockFrames > 0 ? choice.blockFrames : 1, dontNotify);
    fillMonitorLists();
    showOsc();
}

void OutputTab::refresh(const MixerSnapshot& snapshot) {
    const auto& output = model_.output();
    const double rateHz = std::max(1, output.sampleRateHz());
    const bool isWithoutDevice = model_.device().hasNoDevice();
    const auto& render = snapshot.session.render;
    const int count = model_.mix().count();
    int connected = 0;
    for (int j = 0; j < count; ++j) connected += output.hasOutput(j) ? 1 : 0;
    Shade oscShade = Shade::muted;
    const auto osc = oscText(oscShade);
    const double stalledMs = 1e-6 * static_cast<double>(model_.session().world().stalledNs());
    std::vector<StatusRow> rows{
        {"State",
         !snapshot.device.isRunning ? juce::String{"not running"}
         : isWithoutDevice          ? juce::String{"a clock without a device"}
                                    : juce::String{"running"},
         !snapshot.device.isRunning ? Shade::limit
         : isWithoutDevice          ? Shade::highlight
                                    : Shade::text},
        {"Runs at", number(rateHz, 0) + " Hz, blocks of " + juce::String{output.blockFrames()} + " frames (" +
                        number(1e3 * output.blockFrames() / rateHz, 1) + " ms)"},
        {"Felt",
         model_.isVisualOnly()
             ? juce::String{"by nobody: it is seen alone"}
             : number(1e3 * model_.device().outputLatencySeconds(), 1) + " ms after the contact" +
                   (isWithoutDevice ? juce::String{}
                                    : ", and the device's own " +
                                          number(1e3 * output.deviceLatencyFrames() / rateHz, 1) + " ms")},
        {"Heard", monitorText(),
         !model_.device().choice().monitorOutputs.empty() &&
                 model_.device().listening().settings().contacts.empty()
             ? Shade::highlight
             : Shade::text},
        {"Actuators",
         isWithoutDevice ? juce::String{"without a device none has an output"}
                         : juce::String{connected} + " of " + juce::String{count} + " have an output there",
         isWithoutDevice || connected < count ? Shade::highlight : Shade::text},
        {"Load", number(100.0 * snapshot.device.load, 1) + " % of a block, " +
                     number(100.0 * snapshot.device.worstLoad, 1) + " % at most"},
        {"Late", countText(render.late, "hit") + ", " + number(stalledMs, 0) + " ms of stalls",
         render.late > 0 ? Shade::highlight : Shade::text},
        {"Xruns", snapshot.device.deviceXruns < 0 ? juce::String{"not counted by the device"}
                                                  : juce::String{snapshot.device.deviceXruns}},
        {"Opened again", countText(snapshot.device.losses, "time")}};
    std::ranges::move(sinkStatusRows(), std::back_inserter(rows));
    rows.insert(rows.begin() +
                    (model_.inputs().status() ? 1 : static_cast<std::ptrdiff_t>(rows.size())), // in sight
                {"Messages", osc, oscShade});
    statusTable_.set(std::move(rows));
    const auto sinks = model_.session().sinks().states();
    if (const auto ready = std::ranges::count_if(sinks, &SinkState::isReady);
        std::exchange(readySinkCount_, ready) != ready && isScanned_)
        findSinks(), mixChanged();
}

void OutputTab::resized() {
    auto area = getLocalBounds();
    deviceLabel_.setBounds(area.removeFromTop(titleHeight));
    auto row = area.removeFromTop(rowHeight);
    scan_->setBounds(row.removeFromRight(90));
    row.removeFromRight(gap);
    device_.setBounds(row);
    const std::vector<Cell> cells{{rateLabel_, rate_},
                                  {blockLabel_, block_},
                                  {markerLabel_, marker_},
                                  {monitorLabel_, monitor_},
                                  {monitorLevelLabel_, monitorLevel_},
                                  {oscLabel_, osc_},
                                  {receiverLabel_, receiver_},
                                  {phoneLabel_, phone_}};
    placeGrid(area, cells);
    area.removeFromTop(tableGap);
    statusTable_.setBounds(area);
}

void OutputTab::applyOsc() {
    OscChoice choice = model_.inputs().choice();
    const auto before = choice.access;
    choice.access = static_cast<OscAccess>(osc_.getSelectedItemIndex());
    if (const int orientation = phone_.getSelectedItemIndex(); orientation >= 0)
        choice.phoneTurnDegrees = nth(phoneOrientations, orientation).phoneTurnDegrees;
    configureOsc(choice, "Messages by OSC: ");
    const auto osc = model_.inputs().status();
    auto* const host = findParentComponentOfClass<CardHost>();
    if (!osc || choice.access == before || choice.access != OscAccess::anyComputer || host == nullptr) return;
    const auto address = reachableAddress(osc->address),
               first = address.upToFirstOccurrenceOf(" ", false, false);
    auto card = std::make_unique<QuestionCard>(
        "A phone by OSC",
        "Type " + address +
            " into the phone's OSC program: the host before the colon, the port behind it. The code has " +
            first + " as text.",
        std::vector<QuestionCard::Answer>{
            {"Close", [host] { host->setCard(nullptr); }, true, juce::KeyPress{juce::KeyPress::escapeKey}}});
    card->setPicture(qrPicture(first.toStdString()));
    host->setCard(std::move(card));
}

void OutputTab::sendHitsTo(const juce::String& receiver) {
    OscChoice choice = model_.inputs().choice();
    choice.receiver = receiver.trim().toStdString();
    configureOsc(choice, "Hits by OSC: ");
}

void OutputTab::configureOsc(const OscChoice& choice, const juce::String& errorPrefix) {
    if (const auto error = model_.inputs().configure(choice); !error.empty())
        model_.report(errorPrefix + utf8(error));
    showOsc();
}

void OutputTab::chooseReceiver() {
    const int id = receiver_.getSelectedId();
    if (id != otherReceiverId) return sendHitsTo(id == lastReceiverId ? receiver_.getText() : juce::String{});
    showOsc();
    askForText("Hits by OSC", "HOST:PORT of the program",
               receiver_.getItemText(receiver_.indexOfItemId(lastReceiverId)),
               [this](const juce::String& receiver) { sendHitsTo(receiver); });
}

// The last receiver stays in the list when reports to it are switched off.
void OutputTab::showOsc() {
    const OscChoice& choice = model_.inputs().choice();
    const auto lastReceiver = choice.receiver.empty()
                                  ? receiver_.getItemText(receiver_.indexOfItemId(lastReceiverId))
                                  : utf8(choice.receiver);
    osc_.setSelectedItemIndex(static_cast<int>(choice.access), dontNotify);
    receiver_.clear(dontNotify);
    receiver_.addItem("nobody", nobodyId);
    if (lastReceiver.isNotEmpty()) receiver_.addItem(lastReceiver, lastReceiverId);
    receiver_.addItem("another program" + ellipsis(), otherReceiverId);
    receiver_.setSelectedId(choice.receiver.empty() ? nobodyId : lastReceiverId, dontNotify);
    const auto orientation =
        std::ranges::find(phoneOrientations, choice.phoneTurnDegrees, &PhoneOrientation::phoneTurnDegrees);
    phone_.setSelectedItemIndex(static_cast<int>(orientation - phoneOrientations.begin()), dontNotify);
}

juce::String OutputTab::oscText(Shade& tone) const {
    const auto osc = model_.inputs().status();
    tone = osc ? Shade::text : Shade::muted;
    if (!osc) return "none";
    const OscCounts& counts = osc->counts;
    const auto count = [](std::uint64_t n) { return juce::String{static_cast<juce::int64>(n)}; };
    if (counts.failures() + counts.lost + counts.late + osc->unsent > 0) tone = Shade::highlight;
    juce::StringArray parts;
    if (!osc->address.empty())
        parts.add(reachableAddress(osc->address) + ": " + count(counts.messages - counts.refused) +
                  " good, " + count(counts.failures()) + " bad, " + count(counts.late) + " late" +
                  (counts.lost > 0 ? ", " + count(counts.lost) + " lost" : juce::String{}));
    if (!model_.inputs().choice().receiver.empty())
        parts.add("to " + utf8(model_.inputs().choice().receiver) + ": " + count(osc->sent) + " sent" +
                  (osc->unsent > 0 ? ", " + count(osc->unsent) + " not taken" : juce::String{}));
    const auto text = parts.joinIntoString("; ");
    return counts.lastError.empty() ? text : text + "; " + utf8(counts.lastError);
}

} // namespace physvib
