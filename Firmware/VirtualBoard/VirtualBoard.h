// SPDX-License-Identifier: MIT
// Virtual board: runs the unmodified firmware image (ElfImage) in the Unicorn emulator, with models of the
// peripherals (Peripherals) and of the duration of instructions (CycleModel).
// Known limits: interrupts are taken between instruction blocks (up to about a hundred cycles late); the
// clock runs at full speed from reset on; analogue behaviour is not modelled.
#pragma once
#include "Peripherals.h"
#include <capstone/capstone.h>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

// Estimates the cycles of an instruction block on a Cortex-M4F, as an optimistic and a pessimistic bound.
// Both follow the instruction timings of Arm's Cortex-M4 manual (100166, 3.3.1 and 7.2.3): one cycle for
// most, 1 + n for loads of n registers, 14 for floating-point divide and root, one more if a floating-point
// result is used at once.
// - optimistic: consecutive loads and stores take one cycle each; a taken branch one more; flash delivers 8
//   bytes every 3 cycles in advance, and only its throughput limits.
// - pessimistic: each load takes two cycles, as does each floating-point store; a taken branch three more;
//   every 8 bytes of code from flash cost the two wait states, and so does each constant loaded from flash.

namespace physvib::virtualboard {
enum class CostModel { optimistic, pessimistic };

/// A straight run of instructions, without branches.
struct BlockCost {
    std::uint32_t cycles = 0;
    std::uint32_t takenCycles = 0;          ///< extra cycles if it was reached by a branch
    std::vector<std::uint32_t> storeCycles; ///< earliest cycle at which each stored word leaves the core
    bool endsIfThen = false;                ///< an IT block ends in this block
};

class CycleModel {
public:
    explicit CycleModel(CostModel model);
    ~CycleModel();
    CycleModel(const CycleModel&) = delete;
    CycleModel& operator=(const CycleModel&) = delete;

    BlockCost cost(std::span<const std::uint8_t> code, std::uint32_t address) const;

private:
    CostModel model_;
    csh disassembler_ = 0;
};

/// The firmware's ELF file: segments with their flash addresses, and symbols.
struct ElfImage {
    struct Segment {
        std::uint32_t address = 0; ///< load address (flash)
        std::vector<std::uint8_t> bytes;
    };
    struct Symbol {
        std::uint32_t address = 0, size = 0;
    };
    std::vector<Segment> segments;
    std::map<std::string, Symbol> symbols; ///< by mangled name

    /// The symbol whose name contains `part`; throws std::runtime_error if there is none.
    Symbol findSymbol(const std::string& part) const {
        for (const auto& [name, symbol] : symbols)
            if (name.find(part) != std::string::npos) return symbol;
        throw std::runtime_error("no symbol like " + part + " in the image");
    }
};

/// Throws std::runtime_error with the file's name and what was expected.
ElfImage readElf(const std::string& path);
} // namespace physvib::virtualboard
typedef struct uc_struct uc_engine;

namespace physvib::virtualboard {

class VirtualBoard {
public:
    explicit VirtualBoard(const ElfImage& image, CostModel model = CostModel::optimistic,
                          bool hasCrystal = true);
    ~VirtualBoard();
    VirtualBoard(const VirtualBoard&) = delete;
    VirtualBoard& operator=(const VirtualBoard&) = delete;

    /// Runs until that many seconds after power-on. Throws std::runtime_error if the emulator fails.
    void runUntil(double seconds);
    double seconds() const { return static_cast<double>(cycle_) / peripherals_.hz(); }

    /// Sends bytes to the board at line speed, from `seconds` on (0: now).
    void send(std::span<const std::uint8_t> bytes, double seconds = 0.0) {
        const auto from = std::max(cycle_, static_cast<std::uint64_t>(seconds * peripherals_.hz()));
        for (const std::uint8_t byte : bytes)
            peripherals_.queueByte(byte, from + peripherals_.cyclesPerByte());
    }

    /// Bytes sent by the board since the last call.
    std::vector<TimedByte> received() {
        const auto bytes = std::exchange(peripherals_.sentBytes, {});
        return {bytes.begin(), bytes.end()};
    }

    Peripherals& peripherals() { return peripherals_; }
    std::vector<std::uint8_t> memory(std::uint32_t address, std::size_t size) const;
    void writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes);

    std::uint64_t cycle() const { return cycle_; }
    std::uint64_t idleCycles() const { return idleCycles_; }
    /// Whether the processor waits for an interrupt; its memory is then consistent.
    bool isAsleep() const { return isAsleep_; }
    int resets() const { return resetCount_; }
    int faults() const { return faultCount_; }

private:
    struct Exception {
        int number = 0, priority = 0;
        std::uint32_t stack = 0;
    };
    static void onBlock(uc_engine*, std::uint64_t address, std::uint32_t size, void* self);
    static void onStore(uc_engine*, int, std::uint64_t, int, std::int64_t, void* self);
    static void onException(uc_engine*, std::uint32_t number, void* self);
    static std::uint64_t onRead(uc_engine*, std::uint64_t offset, unsigned size, void* region);
    static void onWrite(uc_engine*, std::uint64_t offset, unsigned size, std::uint64_t value, void* region);
    struct Region {
        VirtualBoard* board;
        std::uint32_t base;
    };

    void enterBlock(std::uint32_t address, std::uint32_t size);
    const BlockCost& blockAt(std::uint32_t address, std::uint32_t size);
    std::uint64_t storeCycle() const;
    int currentPriority() const { return exceptionStack_.empty() ? 256 : exceptionStack_.back().priority; }
    void enterException(int vector, int number, int priority);
    void leaveException();
    void reset(bool byWatchdog);
    void runSlice(std::uint64_t end);
    std::uint32_t reg(int id) const;
    void setReg(int id, std::uint32_t value);

    uc_engine* engine_ = nullptr;
    CycleModel model_;
    Peripherals peripherals_;
    std::vector<std::unique_ptr<Region>> regions_;
    std::unordered_map<std::uint64_t, BlockCost> blocks_;
    std::vector<Exception> exceptionStack_;
    const BlockCost* currentBlock_ = nullptr;
    std::uint32_t storesInBlock_ = 0, expectedAddress_ = 0;
    std::uint64_t cycle_ = 0, idleCycles_ = 0, pendingCycles_ = 0, deadline_ = 0;
    bool isStopped_ = false, isAsleep_ = false;
    int exceptionNumber_ = -1, resetCount_ = 0, faultCount_ = 0;
};

} // namespace physvib::virtualboard
