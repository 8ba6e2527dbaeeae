# SPDX-License-Identifier: BSD-3-Clause
# cmake -DNM=... -DOBJECT=... -P linkage.cmake: what the headers define where they are used alone can be linked from any
# number of files: the object that has them all holds no strong symbol of gyrostat.
execute_process(COMMAND "${NM}" -C --defined-only "${OBJECT}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES " W gyrostat::")
  message(FATAL_ERROR "${OBJECT} holds nothing of gyrostat:\n${symbols}")
endif()
string(REGEX MATCHALL " [TDBR] gyrostat::[^\n]*" strong "${symbols}")
if(strong)
  list(JOIN strong "\n" strong)
  message(FATAL_ERROR "defined in a header without inline:\n${strong}")
endif()
