# SPDX-License-Identifier: GPL-3.0-or-later
# Run after a test program is linked: gives its cases with the Catch tag [slow] that label, for ctest.
# PROGRAM: the test program; PREFIX: what ctest puts before a case's name; LABELS: those of every case; OUTPUT: file to write.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} "[slow]~[.]" --list-test-names-only OUTPUT_VARIABLE cases)
string(STRIP "${cases}" cases)
string(REPLACE "\n" ";" cases "${cases}")
set(script "")
foreach(case IN LISTS cases)
    string(APPEND script "set_tests_properties([==[${PREFIX}${case}]==] PROPERTIES LABELS \"slow;${LABELS}\")\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
