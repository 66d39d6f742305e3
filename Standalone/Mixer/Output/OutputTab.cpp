// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of the device, of monitor and triggers, and of OSC, with their status.
#include "Mixer/Output/OutputTab.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {
namespace {

constexpr std::array<int, 6> rates{8000, 44100, 48000, 88200, 96000, 192000};
constexpr std::array<int, 7> blocks{32, 64, 128, 256, 512, 1024, 2048};
constexpr std::array<int, 9> monitorLevels{0, -5, -10, -15, -20, -25, -30, -40, -50};
constexpr int noneId = 1, levelId = 100; // items of lists: 1 + output or pair; 100 - level in dB
constexpr int firstSinkId = 1000;        // item ids of the list of outputs: behind those of devices

struct Cell {
    juce::Label& name;
    juce::Component& box;
};

/// Places names and boxes in columns of one width, from the top of `area`, which is reduced.
void placeGrid(juce::Rectangle<int>& area, const std::vector<Cell>& cells) {
    constexpr int columns = 3;
    const int wide = (area.getWidth() - (columns - 1) * gap) / columns;
    juce::Rectangle<int> names, row;
    for (int k = 0; const Cell& cell : cells) {
        if (k++ % columns == 0)
            names = area.removeFromTop(28).withTrimmedTop(10), row = area.removeFromTop(rowHeight);
        cell.name.setBounds(names.removeFromLeft(wide));
        cell.box.setBounds(row.removeFromLeft(wide));
        names.removeFromLeft(gap);
        row.removeFromLeft(gap);
    }
}

// in the order of OscUse
constexpr std::array<const char*, 3> oscUses{"nobody", "this computer", "phones too"};
struct PhoneHold {
    const char* words;
    double turnDegrees;
};
// direction of its top edge
constexpr std::array<PhoneHold, 4> phoneHolds{
    {{"up", 0.0}, {"left", 90.0}, {"down", 180.0}, {"right", -90.0}}};
constexpr int nobodyId = 1, knownReceiverId = 2, otherReceiverId = 3; // item ids of the list of receivers

/// Addresses at which others reach this computer, in place of 0.0.0.0, and the port.
juce::String reachedAt(const std::string& address) {
    const auto words = utf8(address), port = words.fromLastOccurrenceOf(":", true, false);
    if (!words.startsWith("0.0.0.0")) return words;
    juce::StringArray all;
    for (const auto& own : ownAddresses()) all.add(utf8(own) + port);
    return all.isEmpty() ? words : all.joinIntoString(" or ");
}

} // namespace

OutputTab::OutputTab(MixerModel& model)
    : model_{model} {
    setTitle("Output");
    describe(monitor_, "Monitor",
             "Two outputs, left and right: each hit is heard where it is felt, also without actuators");
    describe(monitorLevel_, "Level of the monitor",
             "What a hit at full scale reaches; the master level leaves it alone. Start low");
    describe(marks_, "Marks",
             "A pulse at the sample of each onset, for trigger boxes. No actuator and no ear belongs there");
    for (const int db : monitorLevels) monitorLevel_.addItem(number(db, 0) + " dBFS", levelId - db);
    for (auto* box : {&monitor_, &monitorLevel_}) box->onChange = [this] { chooseMonitor(); };
    marks_.onChange = [this] {
        model_.reportFault(model_.device().listening().mark(marks_.getSelectedId() - noneId - 1));
        listHeard();
    };
    describe(osc_, "OSC", "Who may strike, tilt and set gains by messages over the network: phones, Pd, Max");
    for (int use = 0; use < static_cast<int>(oscUses.size()); ++use) osc_.addItem(nth(oscUses, use), use + 1);
    describe(hits_, "Hits by OSC",
             "HOST:PORT of a program that hears of each hit as it is felt, and of the status once a second");
    describe(phone_, "Phone", "How a phone is held that tilts the world by OSC: where its top points");
    for (int k = 0; k < static_cast<int>(phoneHolds.size()); ++k)
        phone_.addItem(nth(phoneHolds, k).words, k + 1);
    for (auto* box : {&osc_, &phone_}) box->onChange = [this] { listen(); };
    hits_.onChange = [this] { chooseReceiver(); };
    device_.setTitle("Device");
    rate_.setTitle("Rate");
    block_.setTitle("Block");
    rate_.addItem("default", 1);
    for (const int hz : rates) rate_.addItem(juce::String{hz} + " Hz", hz);
    block_.addItem("default", 1);
    for (const int frames : blocks) block_.addItem(juce::String{frames}, frames);
    scan_ = quietButton("Rescan", "Rescan devices", [this] { scan(); });
    for (auto* box : {&device_, &rate_, &block_}) box->onChange = [this] { open(); };
    addAll(*this, {&deviceName_, &device_,      scan_.get(), &rateName_,         &rate_,         &blockName_,
                   &block_,      &oscName_,     &osc_,       &hitsName_,         &hits_,         &phoneName_,
                   &phone_,      &monitorName_, &monitor_,   &monitorLevelName_, &monitorLevel_, &marksName_,
                   &marks_,      &facts_});
    mixChanged();
}

void OutputTab::scan() {
    found_ = listAudioDevices(model_.device().drivers());
    findSinks();
    isScanned_ = true;
    mixChanged();
}

void OutputTab::findSinks() {
    sinks_.clear();
    for (const SinkKind& kind : sinkKinds()) sinks_.push_back(kind.places());
}

// Lists the sinks that can play beside the device; missing ones are grey, with a text.
void OutputTab::listSinks() {
    rows_.clear();
    device_.addSectionHeading("Beside it");
    const auto add = [this](const SinkKind& kind, const std::string& where, const juce::String& words,
                            bool isThere, bool isUsed) {
        juce::PopupMenu::Item item{juce::String{kind.title.data()} + ": " + words +
                                   (isUsed ? ", in use" : "")};
        item.itemID = firstSinkId + static_cast<int>(rows_.size());
        if (!isThere) item.colour = shade(*this, Shade::muted);
        device_.getRootMenu()->addItem(item);
        rows_.push_back({kind, where, isThere, isUsed});
    };
    sinks_.resize(sinkKinds().size());
    for (std::size_t k = 0; k < sinks_.size(); ++k) {
        const SinkKind& kind = sinkKinds()[k];
        const auto wanted = model_.device().choice().placeOf(kind);
        bool isMissed = !wanted.empty();
        for (const SinkPlace& place : sinks_[k]) {
            const bool isUsed = isMissed && (wanted == place.where || wanted == kind.any);
            add(kind, place.where,
                utf8(place.where) + (place.about.empty() ? juce::String{} : "  " + utf8(place.about)), true,
                isUsed);
            isMissed = isMissed && !isUsed;
        }
        if (isMissed)
            add(kind, wanted, (wanted == kind.any ? "none" : utf8(wanted) + " is not") + " there yet", false,
                true);
        else if (sinks_[k].empty())
            add(kind, std::string{kind.any}, "none is plugged in", false, false);
        if (!kind.other.empty())
            add(kind, {}, "another " + juce::String{kind.other.data()}.toLowerCase() + dots(), true, false);
    }
}

void OutputTab::choose(const SinkRow& row) {
    const SinkKind& kind = row.kind;
    if (row.isUsed) return use(kind, {});
    if (row.where.empty())
        return ask(kind.title.data(), kind.other.data(), utf8(model_.device().choice().placeOf(kind)),
                   [this, &kind](const juce::String& where) { use(kind, where.toStdString()); });
    if (row.isThere) return use(kind, row.where);
    model_.messages().show({juce::String{kind.title.data()} + ": none is plugged in. " + kind.about.data(),
                            true,
                            {"Use it once it is there", [this, &kind] { use(kind, std::string{kind.any}); }},
                            "absent"});
}

void OutputTab::use(const SinkKind& kind, const std::string& where) {
    DeviceChoice choice = model_.device().choice();
    if (choice.placeOf(kind) == where || !model_.device().onSinksWanted) return;
    choice.want(kind, where);
    model_.device().onSinksWanted(choice);
}

void OutputTab::open() {
    if (const auto row = device_.getSelectedId() - firstSinkId; row >= 0) {
        const SinkRow chosen = nth(rows_, row);
        mixChanged(); // shows the unchanged choice: the user may yet cancel
        return choose(chosen);
    }
    const int index = device_.getSelectedId() - 1;
    DeviceChoice choice = model_.device().choice();
    if (index >= 0 && index < static_cast<int>(found_.size()))
        choice.name = nth(found_, index).type + ":" + nth(found_, index).name;
    const bool wereEars = choice.isHeadphones;
    if (index >= 0) choice.isHeadphones = index == static_cast<int>(found_.size()); // the last item
    if (choice.isHeadphones) choice.name = worn_;
    choice.sampleRateHz = rate_.getSelectedId() > 1 ? rate_.getSelectedId() : 0;
    choice.blockFrames = block_.getSelectedId() > 1 ? block_.getSelectedId() : 0;
    choice.isHeadphones && !wereEars ? useHeadphones(model_, choice) : model_.open(choice);
    mixChanged();
}

juce::String OutputTab::ownersOf(int output, bool isMuteTold) const {
    const auto& mix = model_.mix();
    juce::String owners;
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (mix.strips[j].output == output)
            owners << " " << labelOf(mix, j)
                   << (isMuteTold && mix.isSilent(static_cast<int>(j)) ? " (muted)" : "");
    return owners;
}

// Lists output pairs for headphones, with the labels of actuators that would lose an output.
void OutputTab::listHeard() {
    const auto& choice = model_.device().choice();
    monitor_.clear(quietly);
    marks_.clear(quietly);
    monitor_.addItem("none", noneId);
    marks_.addItem("none", noneId);
    for (int k = 0; k < model_.device().outputs(); ++k) {
        if (ownersOf(k).isEmpty()) marks_.addItem("output " + juce::String{k + 1}, noneId + 1 + k);
        if (k % 2 != 0 || k + 1 >= model_.device().outputs()) continue;
        const auto owners = ownersOf(k) + ownersOf(k + 1);
        monitor_.addItem(juce::String{k + 1} + " and " + juce::String{k + 2} +
                             (owners.isEmpty() ? juce::String{} : ", instead of" + owners),
                         noneId + 1 + k);
    }
    monitor_.setSelectedId(choice.monitor.empty() ? noneId : noneId + 1 + choice.monitor[0], quietly);
    if (choice.monitor.size() == 2 && model_.device().listening().settings().contacts.empty()) {
        const auto owners = ownersOf(choice.monitor[0]) + ownersOf(choice.monitor[1]);
        monitor_.setText("off: outputs " + juce::String{choice.monitor[0] + 1} + " and " +
                             juce::String{choice.monitor[1] + 1} +
                             (owners.isEmpty() ? juce::String{} : ", which are of" + owners),
                         quietly);
    }
    monitorLevel_.setSelectedId(levelId - juce::roundToInt(choice.monitorDb), quietly);
    if (monitorLevel_.getSelectedId() == 0)
        monitorLevel_.setText(number(choice.monitorDb, 1) + " dBFS", quietly);
    marks_.setSelectedId(noneId + 1 + choice.marker, quietly);
}

void OutputTab::chooseMonitor() {
    const int left = monitor_.getSelectedId() - noneId - 1;
    const double db = monitorLevel_.getSelectedId() > 0 ? levelId - monitorLevel_.getSelectedId()
                                                        : model_.device().choice().monitorDb;
    model_.reportFault(left < 0 ? model_.device().listening().monitor({}, db)
                                : model_.monitorInstead({left, left + 1}, db));
    listHeard();
}

juce::String OutputTab::heardWords() const {
    const auto& sent = model_.device().listening().settings();
    juce::String words;
    if (!model_.device().isNone() && model_.device().outputs() == 0)
        return "by nobody: the device is not there";
    if (model_.device().choice().isHeadphones)
        for (int ear = 0; ear < DeviceChoice::ears; ++ear)
            words << (ear == 0 ? "left:" : ", right:")
                  << (ownersOf(ear).isEmpty() ? juce::String{" nobody"} : ownersOf(ear, true));
    else if (sent.contacts.size() == 2)
        words << "left on " << sent.contacts[0] + 1 << ", right on " << sent.contacts[1] + 1;
    else if (!model_.device().choice().monitor.empty())
        words << "not there: an actuator, or no output";
    else
        words << "by nobody";
    if (!sent.marks.empty()) words << "; onsets marked on " << sent.marks[0] + 1;
    return words;
}

void OutputTab::ask(const juce::String& title, const juce::String& what, const juce::String& now,
                    std::function<void(const juce::String&)> use) {
    askForValues(*this, title, "Connect", {{what, now}},
                 [use = std::move(use)](const juce::StringArray& values) {
                     if (values[0].isNotEmpty()) use(values[0]);
                 });
}

std::vector<Fact> OutputTab::sinkFacts() const {
    std::vector<Fact> facts;
    for (const SinkState& sink : model_.session().sinks().states()) {
        const bool isPart = sink.isReady && sink.channels > 0 && model_.mix().count() > sink.channels;
        juce::String where = utf8(sink.where);
        if (isPart) where << "; the first " << sink.channels << " actuators";
        facts.push_back({titleOf(sink.name), where, sink.isReady ? Shade::text : Shade::now});
    }
    if (facts.empty()) facts.push_back({"Board", "none", Shade::muted});
    return facts;
}

void OutputTab::mixChanged() {
    const auto& choice = model_.device().choice();
    device_.clear(quietly);
    int chosen = 0;
    const bool isNone = choice.name.starts_with(noDeviceType);
    if (!isNone) worn_ = choice.name;
    for (int id = 1; const auto& d : found_) {
        const auto name = d.type + ":" + d.name;
        device_.addItem(d.type == noDeviceType ? juce::String{noDeviceTitle}
                                               : utf8(name) + " (" + juce::String{d.channels} + " outputs)",
                        id);
        if (name == choice.name) chosen = id;
        if (worn_.empty() && d.type != noDeviceType && d.channels >= DeviceChoice::ears) worn_ = name;
        ++id;
    }
    const int earsId = static_cast<int>(found_.size()) + 1;
    if (!worn_.empty()) device_.addItem("Headphones: " + utf8(worn_) + " (L and R)", earsId);
    if (choice.isHeadphones && !isNone) chosen = earsId;
    listSinks();
    device_.setSelectedId(chosen, quietly);
    auto all = !isNone ? (chosen > 0 ? device_.getText() : utf8(choice.name))
                       : juce::String{choice.sinks.empty() ? noDeviceTitle : "No device"};
    for (const SinkName& sink : choice.sinks) all << " + " << kindOf(sink).title.data();
    device_.setText(all, quietly);
    rate_.setSelectedId(choice.sampleRateHz > 0 ? choice.sampleRateHz : 1, quietly);
    block_.setSelectedId(choice.blockFrames > 0 ? choice.blockFrames : 1, quietly);
    listHeard();
    showOsc();
}

void OutputTab::refresh(const MixerMoment& moment) {
    const auto& output = model_.output();
    const double rate = std::max(1, output.sampleRateHz());
    const bool isNone = model_.device().isNone();
    const auto& r = moment.session.render;
    const int all = model_.mix().count();
    int connected = 0;
    for (int j = 0; j < all; ++j) connected += output.isPlaced(j) ? 1 : 0;
    Shade oscShade = Shade::muted;
    const auto osc = oscState(oscShade);
    const double slipped = 1e-6 * static_cast<double>(model_.session().world().slippedNs());
    std::vector<Fact> facts{
        {"State",
         !moment.device.isRunning ? juce::String{"not running"}
         : isNone                 ? juce::String{"a clock without a device"}
                                  : juce::String{"running"},
         !moment.device.isRunning ? Shade::limit
         : isNone                 ? Shade::now
                                  : Shade::text},
        {"Runs at", number(rate, 0) + " Hz, blocks of " + juce::String{output.blockFrames()} + " frames (" +
                        number(1e3 * output.blockFrames() / rate, 1) + " ms)"},
        {"Felt", model_.isOnlySeen()
                     ? juce::String{"by nobody: it is seen alone"}
                     : number(1e3 * model_.device().outputLatencySeconds(), 1) + " ms after the contact" +
                           (isNone ? juce::String{}
                                   : ", and the device's own " +
                                         number(1e3 * output.deviceLatencyFrames() / rate, 1) + " ms")},
        {"Heard", heardWords(),
         !model_.device().choice().monitor.empty() && model_.device().listening().settings().contacts.empty()
             ? Shade::now
             : Shade::text},
        {"Actuators",
         isNone ? juce::String{"without a device none has an output"}
                : juce::String{connected} + " of " + juce::String{all} + " have an output there",
         isNone || connected < all ? Shade::now : Shade::text},
        {"Load", number(100.0 * moment.device.load, 1) + " % of a block, " +
                     number(100.0 * moment.device.worstLoad, 1) + " % at most"},
        {"Late", countOf(r.late, "hit") + ", " + number(slipped, 0) + " ms of stalls",
         r.late > 0 ? Shade::now : Shade::text},
        {"Xruns", moment.device.deviceXruns < 0 ? juce::String{"not counted by the device"}
                                                : juce::String{moment.device.deviceXruns}},
        {"Opened again", countOf(moment.device.losses, "time")}};
    std::ranges::move(sinkFacts(), std::back_inserter(facts));
    facts.insert(facts.begin() +
                     (model_.inputs().status() ? 1 : static_cast<std::ptrdiff_t>(facts.size())), // in sight
                 {"Messages", osc, oscShade});
    facts_.set(std::move(facts));
    const auto sinks = model_.session().sinks().states();
    if (const auto ready = std::ranges::count_if(sinks, &SinkState::isReady);
        std::exchange(ready_, ready) != ready && isScanned_)
        findSinks(), mixChanged();
}

void OutputTab::resized() {
    auto area = getLocalBounds();
    deviceName_.setBounds(area.removeFromTop(18));
    auto row = area.removeFromTop(rowHeight);
    scan_->setBounds(row.removeFromRight(90));
    row.removeFromRight(gap);
    device_.setBounds(row);
    const std::vector<Cell> cells{{rateName_, rate_},
                                  {blockName_, block_},
                                  {marksName_, marks_},
                                  {monitorName_, monitor_},
                                  {monitorLevelName_, monitorLevel_},
                                  {oscName_, osc_},
                                  {hitsName_, hits_},
                                  {phoneName_, phone_}};
    placeGrid(area, cells);
    area.removeFromTop(12);
    facts_.setBounds(area);
}

void OutputTab::listen() {
    OscChoice choice = model_.inputs().choice();
    const auto before = choice.use;
    choice.use = static_cast<OscUse>(osc_.getSelectedItemIndex());
    if (const int hold = phone_.getSelectedItemIndex(); hold >= 0)
        choice.turnDegrees = nth(phoneHolds, hold).turnDegrees;
    useOsc(choice, "Messages by OSC: ");
    const auto osc = model_.inputs().status();
    auto* const host = findParentComponentOfClass<CardHost>();
    if (!osc || choice.use == before || choice.use != OscUse::anyComputer || host == nullptr) return;
    const auto address = reachedAt(osc->address), first = address.upToFirstOccurrenceOf(" ", false, false);
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
    useOsc(choice, "Hits by OSC: ");
}

void OutputTab::useOsc(const OscChoice& choice, const juce::String& what) {
    if (const auto error = model_.inputs().use(choice); !error.empty()) model_.report(what + utf8(error));
    showOsc();
}

void OutputTab::chooseReceiver() {
    const int id = hits_.getSelectedId();
    if (id != otherReceiverId) return sendHitsTo(id == knownReceiverId ? hits_.getText() : juce::String{});
    showOsc();
    ask("Hits by OSC", "HOST:PORT of the program", hits_.getItemText(hits_.indexOfItemId(knownReceiverId)),
        [this](const juce::String& receiver) { sendHitsTo(receiver); });
}

// A receiver stays in the list when it is switched off.
void OutputTab::showOsc() {
    const OscChoice& choice = model_.inputs().choice();
    const auto known = choice.receiver.empty() ? hits_.getItemText(hits_.indexOfItemId(knownReceiverId))
                                               : utf8(choice.receiver);
    osc_.setSelectedItemIndex(static_cast<int>(choice.use), quietly);
    hits_.clear(quietly);
    hits_.addItem("nobody", nobodyId);
    if (known.isNotEmpty()) hits_.addItem(known, knownReceiverId);
    hits_.addItem("another program" + dots(), otherReceiverId);
    hits_.setSelectedId(choice.receiver.empty() ? nobodyId : knownReceiverId, quietly);
    const auto hold = std::ranges::find(phoneHolds, choice.turnDegrees, &PhoneHold::turnDegrees);
    phone_.setSelectedItemIndex(static_cast<int>(hold - phoneHolds.begin()), quietly);
}

juce::String OutputTab::oscState(Shade& state) const {
    const auto osc = model_.inputs().status();
    state = osc ? Shade::text : Shade::muted;
    if (!osc) return "none";
    const OscCounts& c = osc->counts;
    const auto count = [](std::uint64_t n) { return juce::String{static_cast<juce::int64>(n)}; };
    if (c.wrong() + c.lost + c.late + osc->unsent > 0) state = Shade::now;
    juce::StringArray parts;
    if (!osc->address.empty())
        parts.add(reachedAt(osc->address) + ": " + count(c.messages - c.refused) + " good, " +
                  count(c.wrong()) + " bad, " + count(c.late) + " late" +
                  (c.lost > 0 ? ", " + count(c.lost) + " lost" : juce::String{}));
    if (!model_.inputs().choice().receiver.empty())
        parts.add("to " + utf8(model_.inputs().choice().receiver) + ": " + count(osc->sent) + " sent" +
                  (osc->unsent > 0 ? ", " + count(osc->unsent) + " not taken" : juce::String{}));
    const auto words = parts.joinIntoString("; ");
    return c.fault.empty() ? words : words + "; " + utf8(c.fault);
}

} // namespace physvib
