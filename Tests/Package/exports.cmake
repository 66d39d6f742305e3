# SPDX-License-Identifier: MIT
# A user's module shows its entry point and nothing of ours. What it shows of the standard library has no state.
# Usage: cmake -DMODULE=module.so -P exports.cmake
execute_process(COMMAND nm -D --defined-only ${MODULE} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES " T userEntry\n" OR symbols MATCHES "physvib")
    message(FATAL_ERROR "${MODULE}: expected userEntry and nothing of PhysVib, found:\n${symbols}")
endif()
