// SPDX-License-Identifier: MIT
// The bank of sounding modes (ModeBank), its hash table (ModeIndex) and its input (Strike). Decaying
// sinusoids are linear, so strikes of equal (frequency, decay) merge exactly into one mode with one complex
// amplitude per channel. Cost grows with the materials that sound at once, not with the number of collisions.
//
// A mode's phase is an integer (2^64 = one turn), linear in the absolute frame number; its decay is a
// fixed-point number of octaves. Neither drifts, both are the same bits on every machine, and together they
// are the merge key. At each tile of the absolute frame grid the amplitudes are computed for the tile's first
// frame from these integers. With vector instructions ModeTiles renders whole tiles; otherwise the scalar
// kernel sums sample by sample.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/Modes/ModeTiles.h"
#include "Core/Storage.h"
#include "Core/Trigonometry.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Hash of a mode's increments; its top bits are well mixed (Fibonacci hashing, Knuth vol. 3, 6.4).
inline std::uint64_t modeHash(std::uint64_t phaseIncrement, std::int64_t decayIncrement,
                              bool isGated) noexcept {
    const std::uint64_t mixed =
        (phaseIncrement ^ std::rotl(static_cast<std::uint64_t>(decayIncrement), 29)) + (isGated ? 1 : 0);
    return (mixed ^ mixed >> 31) * 0x9e3779b97f4a7c15;
}

/// Hash table from increments to a mode's slot, of at most `Slots`, with linear probing. The caller keeps the
/// keys: it supplies the hash, and compares the key of a slot.
template <int Slots>
class ModeIndex {
public:
    /// Empties the table and makes room for `slots` slots; there is no room before the first call. False: no
    /// memory. Message thread (M), not while rendering.
    bool resize(int slots) noexcept {
        bits_ = bitsFor(slots);
        size_ = std::size_t{1} << bits_;
        if (!entries_.resize(size_)) return false;
        clear();
        return true;
    }
    void clear() noexcept { std::fill_n(entries_.data(), size_, Entry{}); }

    /// The slot for which `isMatch(slot)` is true, -1 if there is none.
    template <class Predicate>
    int find(std::uint64_t hash, Predicate isMatch) const noexcept {
        for (std::size_t i = home(hash); entries_[i].slot >= 0; i = nextIndex(i))
            if (entries_[i].hash == tag(hash) && isMatch(entries_[i].slot)) return entries_[i].slot;
        return -1;
    }

    void insert(std::uint64_t hash, int slot) noexcept {
        std::size_t i = home(hash);
        while (entries_[i].slot >= 0) i = nextIndex(i);
        entries_[i] = {tag(hash), slot};
    }

    /// Removes a slot that was inserted with this hash. Later entries move up, so that linear probing still
    /// finds them.
    void erase(std::uint64_t hash, int slot) noexcept {
        std::size_t gap = home(hash);
        while (entries_[gap].slot != slot) gap = nextIndex(gap);
        for (std::size_t i = nextIndex(gap); entries_[i].slot >= 0; i = nextIndex(i)) {
            const std::size_t homeIndex = entries_[i].hash >> (32 - bits_);
            if (((i - homeIndex) & mask()) < ((i - gap) & mask())) continue; // its home lies behind the gap
            entries_[gap] = entries_[i];
            gap = i;
        }
        entries_[gap] = {};
    }

private:
    static constexpr int bitsFor(int slots) noexcept {
        return static_cast<int>(std::bit_width(static_cast<unsigned>(2 * slots)));
    }
    struct Entry {
        std::uint32_t hash = 0;
        std::int32_t slot = -1;
    };
    static std::uint32_t tag(std::uint64_t hash) noexcept { return static_cast<std::uint32_t>(hash >> 32); }
    std::size_t mask() const noexcept { return size_ - 1; }
    std::size_t home(std::uint64_t hash) const noexcept { return tag(hash) >> (32 - bits_); }
    std::size_t nextIndex(std::size_t i) const noexcept { return (i + 1) & mask(); }
    Storage<Entry, std::size_t{1} << bitsFor(Slots), true> entries_;
    std::size_t size_ = 0;
    int bits_ = 1;
};

/// One strike (excitation of a mode), already on the frame grid and panned.
struct Strike {
    double frequencyHz = 0.0; ///< below half the sample rate
    double decayPerSecond = 0.0;
    double amplitude = 0.0;
    FramePosition onset;
    std::int64_t closeFrame = never; ///< first frame that is silent again; `never`: it decays fully
    std::uint64_t phase = 0;         ///< at the onset, in turns / 2^64: 0 is a sine
    static constexpr std::int64_t never = INT64_MAX;
};

/// All sounding modes. Memory depends on channels and modes and is allocated in prepare. Render thread (R)
/// only; prepare: message thread (M).
class ModeBank {
public:
    static constexpr int tile = limits::tileFrames;
    static constexpr int slotCount = limits::maxModes + limits::maxFadingModes;

    /// Silence, for this sample rate and number of channels (1 to limits::maxActuators). An instruction set
    /// that is not available selects the scalar kernel. `modes`: modes that sound at once before one is
    /// stolen, 1 to limits::maxModes; `gates`: strikes with a duration that sound at once. False: no memory;
    /// do not use the bank. M, not while rendering.
    bool prepare(int sampleRateHz, int channels, InstructionSet set = InstructionSet::best,
                 int modes = limits::maxModes, int gates = limits::maxGates) noexcept;

    InstructionSet instructionSet() const noexcept { return tiles_.set(); } ///< Any thread after prepare.

    /// Continues at another sample rate and frame: what sounded at `fromFrame` continues at `toFrame`, and
    /// gates close after the same time. M, not while rendering.
    void moveTo(std::int64_t fromFrame, int sampleRateHz, std::int64_t toFrame) noexcept;

    /// `gains`: one per channel. Frames only go forward: the strike's frame is the next one to be rendered,
    /// or, if acceptsStrikesAhead(), a later one of the same tile with no gate to be closed before it. False,
    /// and nothing has changed, if too many gates are open.
    bool strike(const Strike& strike, const double* gains) noexcept;

    /// How many more strikes with a duration can be accepted now.
    int freeGates() const noexcept { return freeGateCount_; }

    bool acceptsStrikesAhead() const noexcept { return tiles_.isOn(); }

    /// The frame at which the next open gate closes; Strike::never if none is open.
    std::int64_t nextGateFrame() const noexcept { return gates_.empty() ? Strike::never : gates_.nextTime(); }

    /// Closes that gate; to be called when its frame is the next one to be rendered.
    void closeNextGate() noexcept;

    /// Fades out all modes from `frame` on, which is the next one to be rendered; by default as fast as
    /// stolen modes.
    void fadeAll(std::int64_t frame, double perSecond = limits::stealFadePerSecond) noexcept;

    /// Writes out[j][0..frames) for absolute frames [first, first + frames), which lie within one tile. False
    /// if all samples are 0.
    bool render(float* const* out, std::int64_t first, int frames) noexcept;

    /// Alternative to render, without a copy: pointers to each channel's samples from frame `first` on. False
    /// if they do not exist in that form; then call render.
    bool findSums(const float** sums, std::int64_t first) noexcept;

    int liveModes() const noexcept { return activeCount_; }
    std::uint64_t stolenModes() const noexcept { return stolen_; }

private:
    struct Mode {
        double frequencyHz = 0.0;
        double decayPerSecond = 0.0;
        std::uint64_t phaseIncrement = 0; // turns / 2^64 per frame
        std::int64_t decayIncrement = 0;  // octaves / 2^56 per frame
        std::int64_t referenceFrame = 0;  // amplitudes are those at this frame's decay; their phase is
                                          // absolute
        std::int64_t endFrame = 0;        // first frame after its end
        std::int64_t lifeFrames = 0;      // life of a strike
        std::uint32_t generation = 0;     // distinguishes this use of the slot from earlier ones
        int openGates = 0;
        bool isGated = false; // gated and other strikes do not merge, so that closing can leave exact zeros
        bool isFading = false;
        std::uint64_t hash() const noexcept { return modeHash(phaseIncrement, decayIncrement, isGated); }
        bool fits(const Strike& s) const noexcept { // sufficient, not necessary: other frequencies may have
                                                    // the same increments
            return generation != 0 && !isFading && frequencyHz == s.frequencyHz &&
                   decayPerSecond == s.decayPerSecond && isGated == (s.closeFrame != Strike::never);
        }
        bool matches(const Mode& o) const noexcept {
            return phaseIncrement == o.phaseIncrement && decayIncrement == o.decayIncrement &&
                   isGated == o.isGated && !isFading;
        }
    };
    struct Gate {
        int slot = 0;
        std::uint32_t generation = 0;
        int entry = 0; // index of its gains
        FramePosition onset;
        std::uint64_t phase = 0;
    };

    bool allocate(InstructionSet set, int gates) noexcept;
    Mode makeMode(const Strike& strike) const noexcept;
    void setIncrements(Mode& mode) const noexcept;
    int findOrCreateSlot(const Strike& strike) noexcept;
    int create(const Mode& mode) noexcept;
    void add(int slot, const Strike& strike, const double* gains) noexcept;
    void release(int slot) noexcept;
    void recycle(int slot) noexcept;
    void fade(int slot, std::int64_t frame, double perSecond = limits::stealFadePerSecond) noexcept;
    int quietest(bool isFading) const noexcept;
    void fillPowers(int slot) noexcept;
    void rebase(int slot) noexcept;
    void refreshTile(int slot) noexcept;
    void refreshAll(bool isNextTile) noexcept;
    void renewCarrier(int slot) noexcept;
    void retireModes() noexcept;
    void updateMode(int slot) noexcept;
    void enterTile(std::int64_t frame) noexcept;
    bool openGate(int slot, const Strike& strike, const double* gains) noexcept;
    Complex<double> carrier(const Mode& mode) const noexcept;
    static PhaseDecay onsetPhaseDecay(const Mode& mode, FramePosition onset, std::uint64_t phase) noexcept;
    static Complex<double> toPhasor(const PhaseDecay& factor) noexcept {
        return unitPhasor<double>(factor.phase) * decayFactor<double>(factor.octaves);
    }
    Mode& mode(int slot) noexcept { return slotModes_[static_cast<std::size_t>(slot)]; }
    const Mode& mode(int slot) const noexcept { return slotModes_[static_cast<std::size_t>(slot)]; }
    std::size_t row(int slot) const noexcept { return static_cast<std::size_t>(slot * channels_); }

    static constexpr auto slots = static_cast<std::size_t>(slotCount);
    static constexpr auto tileSize = static_cast<std::size_t>(tile);
    static constexpr auto width = static_cast<std::size_t>(limits::maxActuators);
    static constexpr auto gateCount = static_cast<std::size_t>(limits::maxGates);
    static constexpr std::size_t padding = tiles::channelsPerLine; // because tiles read whole cache lines
    template <class T, std::size_t max>
    using Buffer = Storage<T, max, true>;

    int channels_ = 1;
    double rate_ = 48000.0;
    std::int64_t tileStart_ = 0;
    int slots_ = 0, modes_ = 0;
    Buffer<int, slots> activeSlots_; // slots in the order of their first strike
    Buffer<int, slots> freeSlots_;   // a stack
    int activeCount_ = 0;
    int freeCount_ = 0;
    int fadingCount_ = 0;
    std::int64_t nextEnd_ = Strike::never; // no mode ends before this frame
    std::uint64_t stolen_ = 0;
    std::uint32_t generations_ = 0;
    Buffer<Mode, slots> slotModes_;
    ModeIndex<slotCount> index_; // of modes that are not fading
    ModeTiles tiles_;
    std::array<std::int32_t, 256> recentSlots_{}; // slots that were struck recently, by hash of the frequency
    Buffer<Complex<double>, slots * width + padding> amplitudes_; // at the mode's reference frame
    Buffer<Complex<double>, slots * width> tileAmplitudes_; // at the tile's first frame; scalar kernel only
    Buffer<double, slots * tileSize> cosPowers_;
    Buffer<double, slots * tileSize> sinPowers_;
    TimeOrdered<Gate, limits::maxGates, true> gates_;
    Buffer<double, gateCount * width> gateGains_; // amplitude times gain, per channel
    Buffer<int, gateCount> freeGates_;
    int freeGateCount_ = 0;
};

} // namespace physvib
