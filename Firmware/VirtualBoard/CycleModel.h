// SPDX-License-Identifier: MIT
// What a block of instructions costs on a Cortex-M4F: two figures between which the truth is expected to lie.
//
// Both follow the instruction timings of Arm's Cortex-M4 manual (100166, 3.3.1 and 7.2.3): one cycle for
// most, loads of n registers 1 + n, floating-point divide and root 14, one more if a floating-point result is
// used at once.
//   optimistic:  loads and stores in a row take one cycle each; a taken branch one more; flash delivers 8
//   bytes every
//                3 cycles in advance, and only a lack of them is waited for.
//   pessimistic: each load takes two cycles, as does each floating-point store; a taken branch costs three
//   more; every
//                8 bytes of code from flash cost the two wait states, and so does each constant loaded from
//                there.
#pragma once
#include <capstone/capstone.h>
#include <cstdint>
#include <span>
#include <vector>

namespace physvib::virtualboard {

enum class CostModel { optimistic, pessimistic };

/// One straight run of instructions.
struct BlockCost {
    std::uint32_t instructions = 0, cycles = 0;
    std::uint32_t takenCycles = 0;          ///< on top, if it was jumped to
    std::vector<std::uint32_t> storeCycles; ///< when each word written leaves the core, shortest
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

} // namespace physvib::virtualboard
