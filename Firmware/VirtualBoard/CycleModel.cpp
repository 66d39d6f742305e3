// SPDX-License-Identifier: MIT
// Cycle cost of each instruction, decoded with Capstone.
#include "VirtualBoard.h"
#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace physvib::virtualboard {
namespace {

struct Instruction {
    std::string_view name;
    std::span<const cs_arm_op> operands;

    bool is(std::initializer_list<std::string_view> beginnings) const {
        return std::any_of(beginnings.begin(), beginnings.end(),
                           [this](auto b) { return name.starts_with(b); });
    }
    bool isRegister(std::size_t i) const { return i < operands.size() && operands[i].type == ARM_OP_REG; }
    int reg(std::size_t i) const { return isRegister(i) ? operands[i].reg : ARM_REG_INVALID; }

    // Words transferred by a multiple load or store.
    std::uint32_t words() const {
        std::uint32_t n = 0;
        for (const auto& o : operands)
            if (o.type == ARM_OP_REG) n += o.reg >= ARM_REG_D0 && o.reg <= ARM_REG_D31 ? 2 : 1;
        const bool hasBase = is({"ldm", "stm", "vldm", "vstm"});
        return n - (hasBase ? 1 : 0);
    }
    bool movesMany() const { return is({"ldm", "stm", "push", "pop", "vldm", "vstm", "vpush", "vpop"}); }
    bool isArithmetic() const {
        return is({"vadd", "vsub", "vmul", "vnmul", "vcvt", "vdiv", "vsqrt", "vmla", "vmls", "vfma", "vfms",
                   "vfnm"});
    }
    bool isLoad() const { return is({"ldr", "vldr"}); }
    bool isStore() const { return is({"str", "vstr"}); }
    std::uint32_t wordsStored() const {
        if (is({"strd"})) return 2;
        if (isStore()) return 1;
        return is({"push", "stm", "vpush", "vstm"}) ? words() : 0;
    }
    bool loadsConstant() const {
        return isLoad() && std::any_of(operands.begin(), operands.end(), [](auto& o) {
                   return o.type == ARM_OP_MEM && o.mem.base == ARM_REG_PC;
               });
    }
    bool uses(int wanted) const {
        for (std::size_t i = isStore() || is({"vcmp"}) ? 0 : 1; i < operands.size(); ++i)
            if (reg(i) == wanted) return true;
        return false;
    }
};

// Cycles without stalls; `follows`: directly after another load or store.
std::uint32_t plainCycles(const Instruction& i, bool follows, CostModel model) {
    const bool slow = model == CostModel::pessimistic;
    if (i.movesMany())
        return 1 + i.words() +
               (i.is({"pop", "ldm"}) && i.reg(i.operands.size() - 1) == ARM_REG_PC ? (slow ? 3 : 2) : 0);
    if (i.is({"ldrd", "strd"})) return 3;
    if (i.is({"vdiv", "vsqrt"})) return 14;
    if (i.is({"vmla", "vmls", "vfma", "vfms", "vfnm"})) return 3;
    if (i.isLoad()) return slow || !follows ? 2 : 1;
    if (i.isStore()) return slow && i.is({"vstr"}) ? 2 : 1;
    if (i.is({"sdiv", "udiv"})) return slow ? 12 : 2;
    if (i.is({"dmb", "dsb", "isb"})) return 4;
    return 1;
}

} // namespace

CycleModel::CycleModel(CostModel model)
    : model_{model} {
    if (cs_open(CS_ARCH_ARM, static_cast<cs_mode>(CS_MODE_THUMB | CS_MODE_MCLASS), &disassembler_) !=
        CS_ERR_OK)
        throw std::runtime_error("Capstone does not start");
    cs_option(disassembler_, CS_OPT_DETAIL, CS_OPT_ON);
}

CycleModel::~CycleModel() { cs_close(&disassembler_); }

BlockCost CycleModel::cost(std::span<const std::uint8_t> code, std::uint32_t address) const {
    constexpr std::uint32_t flashEnd = 0x08010000, waitStates = 2, bytesPerFetch = 8;
    const bool isFlash = address < flashEnd, slow = model_ == CostModel::pessimistic;
    BlockCost b;
    std::uint32_t shortest = 0, stored = 0;
    int lastResult = ARM_REG_INVALID;
    bool wasAccess = false;
    std::size_t conditional = 0; // instructions of an IT block that are still to come
    cs_insn* found = nullptr;
    const std::size_t count = cs_disasm(disassembler_, code.data(), code.size(), address, 0, &found);
    for (std::size_t k = 0; k < count; ++k) {
        const auto& detail = found[k].detail->arm;
        const Instruction i{found[k].mnemonic, {detail.operands, detail.op_count}};
        stored = i.wordsStored();
        if (found[k].id == ARM_INS_IT) { // "it", "ite", "ittt": one each
            conditional = std::string_view{found[k].mnemonic}.size() - 1;
            b.endsIfThen = false;
        } else if (conditional > 0) {
            b.endsIfThen = --conditional == 0;
        }
        for (std::uint32_t w = 0; w < stored; ++w) b.storeCycles.push_back(shortest + w);
        const std::uint32_t stall = lastResult != ARM_REG_INVALID && i.uses(lastResult) ? 1 : 0;
        b.cycles += plainCycles(i, wasAccess, model_) + stall +
                    (slow && isFlash && i.loadsConstant() ? waitStates : 0);
        shortest += plainCycles(i, wasAccess, CostModel::optimistic) + stall;
        lastResult = i.isArithmetic() ? i.reg(0) : ARM_REG_INVALID;
        wasAccess = i.isLoad() || i.isStore();
    }
    if (count > 0) cs_free(found, count);
    const auto fetches = static_cast<std::uint32_t>((code.size() + bytesPerFetch - 1) / bytesPerFetch);
    if (isFlash && slow) b.cycles += waitStates * fetches;
    if (isFlash && !slow) b.cycles = std::max(b.cycles, (1 + waitStates) * fetches);
    b.takenCycles = slow ? 3 : 1 + (isFlash ? waitStates : 0);
    return b;
}

} // namespace physvib::virtualboard
