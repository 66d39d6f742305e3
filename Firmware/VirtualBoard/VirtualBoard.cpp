// SPDX-License-Identifier: MIT
// Processor of the virtual board: the cycles of instructions, decoded with Capstone; instruction blocks,
// exceptions and sleep in Unicorn; and the ELF reader.
#include "VirtualBoard.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <elf.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <unicorn/unicorn.h>
#include <utility>

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
    bool isMultiple() const { return is({"ldm", "stm", "push", "pop", "vldm", "vstm", "vpush", "vpop"}); }
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
    bool reads(int registerId) const {
        for (std::size_t i = isStore() || is({"vcmp"}) ? 0 : 1; i < operands.size(); ++i)
            if (reg(i) == registerId) return true;
        return false;
    }
};

// Cycles without stalls; `isConsecutive`: directly after another load or store.
std::uint32_t plainCycles(const Instruction& i, bool isConsecutive, CostModel model) {
    const bool isPessimistic = model == CostModel::pessimistic;
    if (i.isMultiple())
        return 1 + i.words() +
               (i.is({"pop", "ldm"}) && i.reg(i.operands.size() - 1) == ARM_REG_PC ? (isPessimistic ? 3 : 2)
                                                                                   : 0);
    if (i.is({"ldrd", "strd"})) return 3;
    if (i.is({"vdiv", "vsqrt"})) return 14;
    if (i.is({"vmla", "vmls", "vfma", "vfms", "vfnm"})) return 3;
    if (i.isLoad()) return isPessimistic || !isConsecutive ? 2 : 1;
    if (i.isStore()) return isPessimistic && i.is({"vstr"}) ? 2 : 1;
    if (i.is({"sdiv", "udiv"})) return isPessimistic ? 12 : 2;
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
    const bool isFlash = address < flashEnd, isPessimistic = model_ == CostModel::pessimistic;
    BlockCost block;
    std::uint32_t minCycles = 0, storedWords = 0;
    int lastResult = ARM_REG_INVALID;
    bool wasMemoryAccess = false;
    std::size_t remainingConditional = 0; // instructions of an IT block that are still to come
    cs_insn* instructions = nullptr;
    const std::size_t count = cs_disasm(disassembler_, code.data(), code.size(), address, 0, &instructions);
    for (std::size_t k = 0; k < count; ++k) {
        const auto& detail = instructions[k].detail->arm;
        const Instruction i{instructions[k].mnemonic, {detail.operands, detail.op_count}};
        storedWords = i.wordsStored();
        if (instructions[k].id == ARM_INS_IT) { // "it", "ite", "ittt": one each
            remainingConditional = std::string_view{instructions[k].mnemonic}.size() - 1;
            block.endsIfThen = false;
        } else if (remainingConditional > 0) {
            block.endsIfThen = --remainingConditional == 0;
        }
        for (std::uint32_t w = 0; w < storedWords; ++w) block.storeCycles.push_back(minCycles + w);
        const std::uint32_t stall = lastResult != ARM_REG_INVALID && i.reads(lastResult) ? 1 : 0;
        block.cycles += plainCycles(i, wasMemoryAccess, model_) + stall +
                        (isPessimistic && isFlash && i.loadsConstant() ? waitStates : 0);
        minCycles += plainCycles(i, wasMemoryAccess, CostModel::optimistic) + stall;
        lastResult = i.isArithmetic() ? i.reg(0) : ARM_REG_INVALID;
        wasMemoryAccess = i.isLoad() || i.isStore();
    }
    if (count > 0) cs_free(instructions, count);
    const auto fetches = static_cast<std::uint32_t>((code.size() + bytesPerFetch - 1) / bytesPerFetch);
    if (isFlash && isPessimistic) block.cycles += waitStates * fetches;
    if (isFlash && !isPessimistic) block.cycles = std::max(block.cycles, (1 + waitStates) * fetches);
    block.takenCycles = isPessimistic ? 3 : 1 + (isFlash ? waitStates : 0);
    return block;
}

namespace {

constexpr std::uint32_t flashBase = 0x08000000, flashSize = 0x10000, sramBase = 0x20000000, sramSize = 0x3000,
                        fastBase = 0x10000000, fastSize = 0x1000;
constexpr int hardFault = 3, firstExternal = 16, faultPriority = -1;
constexpr std::uint32_t frameBytes = 104, returnToThread = 0xFFFFFFE9, exceptionReturns = 0xFFFFFF00;
constexpr int unicornExceptionReturn = 8; // EXCP_EXCEPTION_EXIT
constexpr std::array<int, 8> stackedCore{UC_ARM_REG_R0,  UC_ARM_REG_R1, UC_ARM_REG_R2, UC_ARM_REG_R3,
                                         UC_ARM_REG_R12, UC_ARM_REG_LR, UC_ARM_REG_PC, UC_ARM_REG_XPSR};
constexpr std::array<int, 16> stackedFloat{UC_ARM_REG_S0,  UC_ARM_REG_S1,  UC_ARM_REG_S2,  UC_ARM_REG_S3,
                                           UC_ARM_REG_S4,  UC_ARM_REG_S5,  UC_ARM_REG_S6,  UC_ARM_REG_S7,
                                           UC_ARM_REG_S8,  UC_ARM_REG_S9,  UC_ARM_REG_S10, UC_ARM_REG_S11,
                                           UC_ARM_REG_S12, UC_ARM_REG_S13, UC_ARM_REG_S14, UC_ARM_REG_S15};
constexpr std::uint32_t ifThenBits = 0x0600FC00; // of XPSR
constexpr int entryCycles = 12, exitCycles = 12; // Arm 100166, 3.9.1

void require(uc_err error, const char* what) {
    if (error != UC_ERR_OK)
        throw std::runtime_error(std::string("virtual board: ") + what + ": " + uc_strerror(error));
}

} // namespace

VirtualBoard::VirtualBoard(const ElfImage& image, CostModel model, bool hasCrystal)
    : model_{model} {
    peripherals_.hasCrystal = hasCrystal;
    require(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &engine_), "open");
    require(uc_ctl_set_cpu_model(engine_, UC_CPU_ARM_CORTEX_M4), "processor");
    require(uc_mem_map(engine_, flashBase, flashSize, UC_PROT_READ | UC_PROT_EXEC), "flash");
    require(uc_mem_map(engine_, sramBase, sramSize, UC_PROT_ALL), "memory");
    require(uc_mem_map(engine_, fastBase, fastSize, UC_PROT_ALL), "memory beside the core");
    for (const auto& segment : image.segments)
        require(uc_mem_write(engine_, segment.address, segment.bytes.data(), segment.bytes.size()), "image");
    for (const std::uint32_t base :
         {0x40001000u, 0x40003000u, 0x40004000u, 0x40007000u, 0x40010000u, 0x40013000u, 0x40021000u,
          0x40022000u, 0x48000000u, 0xE0001000u, 0xE000E000u}) {
        regions_.push_back(std::make_unique<Region>(Region{this, base}));
        require(
            uc_mmio_map(engine_, base, 0x1000, onRead, regions_.back().get(), onWrite, regions_.back().get()),
            "registers");
    }
    uc_hook hook;
    require(uc_hook_add(engine_, &hook, UC_HOOK_BLOCK, reinterpret_cast<void*>(onBlock), this, 1, 0), "hook");
    require(uc_hook_add(engine_, &hook, UC_HOOK_INTR, reinterpret_cast<void*>(onException), this, 1, 0),
            "hook");
    require(uc_hook_add(engine_, &hook, UC_HOOK_MEM_WRITE, reinterpret_cast<void*>(onStore), this, 1, 0),
            "hook");
    reset(false);
}

VirtualBoard::~VirtualBoard() { uc_close(engine_); }

std::uint32_t VirtualBoard::reg(int id) const {
    std::uint32_t value = 0;
    uc_reg_read(engine_, id, &value);
    return value;
}

void VirtualBoard::setReg(int id, std::uint32_t value) { uc_reg_write(engine_, id, &value); }

void VirtualBoard::reset(bool byWatchdog) {
    resetCount_ += byWatchdog ? 1 : 0;
    exceptionStack_.clear();
    peripherals_.reset(byWatchdog);
    std::array<std::uint32_t, 2> start{};
    uc_mem_read(engine_, flashBase, start.data(), sizeof start);
    setReg(UC_ARM_REG_SP, start[0]);
    setReg(UC_ARM_REG_PC, start[1]);
}

std::vector<std::uint8_t> VirtualBoard::memory(std::uint32_t address, std::size_t size) const {
    std::vector<std::uint8_t> bytes(size);
    require(uc_mem_read(engine_, address, bytes.data(), size), "read");
    return bytes;
}

void VirtualBoard::writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    require(uc_mem_write(engine_, address, bytes.data(), bytes.size()), "write");
    uc_ctl_remove_cache(engine_, static_cast<std::uint64_t>(address),
                        static_cast<std::uint64_t>(address + bytes.size()));
}

// Advances time by instruction blocks.

const BlockCost& VirtualBoard::blockAt(std::uint32_t address, std::uint32_t size) {
    const std::uint64_t key = static_cast<std::uint64_t>(address) << 32 | size;
    const auto found = blocks_.find(key);
    if (found != blocks_.end()) return found->second;
    std::vector<std::uint8_t> code(size);
    uc_mem_read(engine_, address, code.data(), size);
    return blocks_.emplace(key, model_.cost(code, address)).first->second;
}

void VirtualBoard::enterBlock(std::uint32_t address, std::uint32_t size) {
    cycle_ += std::exchange(pendingCycles_, 0);
    if (cycle_ >= deadline_ || peripherals_.pendingInterrupt(currentPriority()) >= 0) {
        isStopped_ = true;
        uc_emu_stop(engine_);
        return;
    }
    currentBlock_ = &blockAt(address, size);
    pendingCycles_ = currentBlock_->cycles + (address != expectedAddress_ ? currentBlock_->takenCycles : 0);
    expectedAddress_ = address + size;
    storesInBlock_ = 0;
}

std::uint64_t VirtualBoard::storeCycle() const {
    if (currentBlock_ == nullptr || storesInBlock_ == 0) return cycle_;
    const auto& cycles = currentBlock_->storeCycles;
    return cycle_ + (cycles.empty() ? 0 : cycles[std::min<std::size_t>(storesInBlock_, cycles.size()) - 1]);
}

void VirtualBoard::onBlock(uc_engine*, std::uint64_t address, std::uint32_t size, void* self) {
    static_cast<VirtualBoard*>(self)->enterBlock(static_cast<std::uint32_t>(address), size);
}

void VirtualBoard::onStore(uc_engine*, int, std::uint64_t, int, std::int64_t, void* self) {
    auto& board = *static_cast<VirtualBoard*>(self);
    ++board.storesInBlock_;
    // Unicorn 2.1.4 keeps the IT bits of a block with a store until another block ends, so they are cleared
    if (board.currentBlock_ != nullptr && board.currentBlock_->endsIfThen)
        board.setReg(UC_ARM_REG_XPSR, board.reg(UC_ARM_REG_XPSR) & ~ifThenBits);
}

void VirtualBoard::onException(uc_engine* engine, std::uint32_t number, void* self) {
    auto& board = *static_cast<VirtualBoard*>(self);
    board.exceptionNumber_ = static_cast<int>(number);
    board.isStopped_ = true;
    uc_emu_stop(engine);
}

std::uint64_t VirtualBoard::onRead(uc_engine*, std::uint64_t offset, unsigned, void* region) {
    const auto& r = *static_cast<Region*>(region);
    return r.board->peripherals_.read(r.base + static_cast<std::uint32_t>(offset), r.board->cycle_);
}

void VirtualBoard::onWrite(uc_engine*, std::uint64_t offset, unsigned size, std::uint64_t value,
                           void* region) {
    const auto& r = *static_cast<Region*>(region);
    r.board->peripherals_.write(r.base + static_cast<std::uint32_t>(offset),
                                static_cast<std::uint32_t>(value), size, r.board->storeCycle());
    // the write may have caused an earlier event
    r.board->deadline_ = std::min(r.board->deadline_, r.board->peripherals_.nextEvent());
}

// Exceptions (ARMv7-M manual, B1.5). Words of a stack frame: 0-7 core, 8-23 floating point, 24 FPSCR.

void VirtualBoard::enterException(int vector, int number, int priority) {
    std::array<std::uint32_t, frameBytes / 4> frame{};
    for (std::size_t i = 0; i < stackedCore.size(); ++i) frame[i] = reg(stackedCore[i]);
    frame[6] &= ~1u;
    for (std::size_t i = 0; i < stackedFloat.size(); ++i) frame[8 + i] = reg(stackedFloat[i]);
    frame[24] = reg(UC_ARM_REG_FPSCR);
    // Unicorn may stop between an IT instruction and the instructions that depend on it
    setReg(UC_ARM_REG_XPSR, frame[7] & ~ifThenBits);
    const std::uint32_t oldStack = reg(UC_ARM_REG_SP), stack = (oldStack & ~7u) - frameBytes;
    require(uc_mem_write(engine_, stack, frame.data(), frameBytes), "stack");
    setReg(UC_ARM_REG_SP, stack);
    exceptionStack_.push_back({number, priority, oldStack});
    std::uint32_t handler = 0;
    uc_mem_read(engine_, flashBase + 4u * static_cast<std::uint32_t>(vector), &handler, 4);
    setReg(UC_ARM_REG_LR, returnToThread);
    setReg(UC_ARM_REG_PC, handler);
    cycle_ += entryCycles;
    expectedAddress_ = 0;
}

void VirtualBoard::leaveException() {
    std::array<std::uint32_t, frameBytes / 4> frame{};
    uc_mem_read(engine_, reg(UC_ARM_REG_SP), frame.data(), frameBytes);
    for (std::size_t i = 0; i < stackedFloat.size(); ++i) setReg(stackedFloat[i], frame[8 + i]);
    setReg(UC_ARM_REG_FPSCR, frame[24]);
    for (const std::size_t i : {0u, 1u, 2u, 3u, 4u, 5u, 7u}) setReg(stackedCore[i], frame[i]);
    setReg(UC_ARM_REG_SP, exceptionStack_.back().stack);
    setReg(UC_ARM_REG_PC, frame[6] | 1);
    exceptionStack_.pop_back();
    cycle_ += exitCycles;
    expectedAddress_ = 0;
}

// Runs until the next event of a peripheral.

void VirtualBoard::runSlice(std::uint64_t end) {
    peripherals_.advance(cycle_);
    if (peripherals_.isWatchdogExpired(cycle_)) reset(true);
    if (const int number = peripherals_.pendingInterrupt(currentPriority()); number >= 0)
        enterException(firstExternal + number, number, peripherals_.priority(number));
    deadline_ = std::min(peripherals_.nextEvent(), end);
    isStopped_ = isAsleep_ = false;
    exceptionNumber_ = -1;
    const uc_err error = uc_emu_start(engine_, reg(UC_ARM_REG_PC) | 1, 0xFFFFFFF0, 0, 0);
    cycle_ += std::exchange(pendingCycles_, 0);
    currentBlock_ = nullptr;
    const bool isReturn = exceptionNumber_ == unicornExceptionReturn ||
                          (reg(UC_ARM_REG_PC) & exceptionReturns) == exceptionReturns;
    if (isReturn && !exceptionStack_.empty()) return leaveException();
    if (error != UC_ERR_OK || exceptionNumber_ >= 0) {
        if (++faultCount_ > 100) throw std::runtime_error("virtual board: fault upon fault");
        return enterException(hardFault, -hardFault, faultPriority);
    }
    if (isStopped_ || peripherals_.pendingInterrupt(currentPriority()) >= 0 || deadline_ <= cycle_) return;
    isAsleep_ = exceptionStack_.empty();
    idleCycles_ += deadline_ - cycle_;
    cycle_ = deadline_;
}

void VirtualBoard::runUntil(double seconds) {
    const auto end = static_cast<std::uint64_t>(seconds * peripherals_.hz());
    while (cycle_ < end) runSlice(end);
}

// Parses the 32-bit little-endian ELF files that the firmware's linker writes.

namespace {

template <class T>
T readAt(const std::vector<std::uint8_t>& file, std::size_t offset) {
    if (offset + sizeof(T) > file.size()) throw std::runtime_error("ends too early");
    T value;
    std::memcpy(&value, file.data() + offset, sizeof value);
    return value;
}

void readSegments(const std::vector<std::uint8_t>& file, const Elf32_Ehdr& head, ElfImage& image) {
    for (unsigned i = 0; i < head.e_phnum; ++i) {
        const auto part = readAt<Elf32_Phdr>(file, head.e_phoff + i * sizeof(Elf32_Phdr));
        if (part.p_type != PT_LOAD || part.p_filesz == 0) continue;
        if (part.p_offset + static_cast<std::size_t>(part.p_filesz) > file.size())
            throw std::runtime_error("ends too early");
        const auto begin = file.begin() + static_cast<std::ptrdiff_t>(part.p_offset);
        image.segments.push_back({part.p_paddr, {begin, begin + static_cast<std::ptrdiff_t>(part.p_filesz)}});
    }
}

void readSymbols(const std::vector<std::uint8_t>& file, const Elf32_Ehdr& head, ElfImage& image) {
    for (unsigned i = 0; i < head.e_shnum; ++i) {
        const auto section = readAt<Elf32_Shdr>(file, head.e_shoff + i * sizeof(Elf32_Shdr));
        if (section.sh_type != SHT_SYMTAB) continue;
        const auto names = readAt<Elf32_Shdr>(file, head.e_shoff + section.sh_link * sizeof(Elf32_Shdr));
        for (std::size_t k = 0; k < section.sh_size / sizeof(Elf32_Sym); ++k) {
            const auto symbol = readAt<Elf32_Sym>(file, section.sh_offset + k * sizeof(Elf32_Sym));
            std::string name;
            for (std::size_t c = names.sh_offset + symbol.st_name; c < file.size() && file[c] != 0; ++c)
                name += static_cast<char>(file[c]);
            image.symbols[name] = {symbol.st_value, symbol.st_size};
        }
    }
}

} // namespace

ElfImage readElf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    const std::vector<std::uint8_t> file((std::istreambuf_iterator<char>(in)), {});
    ElfImage image;
    try {
        const auto head = readAt<Elf32_Ehdr>(file, 0);
        if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_machine != EM_ARM)
            throw std::runtime_error("expected an Arm ELF file");
        readSegments(file, head, image);
        readSymbols(file, head, image);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(path + ": " + e.what());
    }
    return image;
}

} // namespace physvib::virtualboard
