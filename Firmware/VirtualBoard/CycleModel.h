// SPDX-License-Identifier: MIT
// Estimates the cycles of an instruction block on a Cortex-M4F, as an optimistic and a pessimistic bound.
//
// Both follow the instruction timings of Arm's Cortex-M4 manual (100166, 3.3.1 and 7.2.3): one cycle for
// most, 1 + n for loads of n registers, 14 for floating-point divide and root, one more if a floating-point
// result is used at once.
// - optimistic: consecutive loads and stores take one cycle each; a taken branch one more; flash delivers 8
//   bytes every 3 cycles in advance, and only its throughput limits.
// - pessimistic: each load takes two cycles, as does each floating-point store; a taken branch three more;
//   every 8 bytes of code from flash cost the two wait states, and so does each constant loaded from flash.
#pragma once
#include <capstone/capstone.h>
#include <cstdint>
#include <span>
#include <vector>

namespace physvib::virtualboard {

enum class CostModel { optimistic, pessimistic };

/// A straight run of instructions, without branches.
struct BlockCost {
    std::uint32_t cycles = 0;
    std::uint32_t takenCycles = 0;          ///< extra cycles if it was reached by a branch
    std::vector<std::uint32_t> storeCycles; ///< earliest cycle at which each stored word leaves the core
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
