# SPDX-License-Identifier: GPL-3.0-or-later
# Run after a test program is linked: writes the ctest labels of its cases, which are their Catch tags [slow] and [threads].
# PROGRAM: the test program; PREFIX: what ctest puts before a case's name; OUTPUT: the file to write.
cmake_minimum_required(VERSION 3.25)
set(names)
foreach(tag slow threads)
    execute_process(COMMAND ${PROGRAM} "[${tag}]~[.]" --list-test-names-only OUTPUT_VARIABLE cases)
    string(STRIP "${cases}" cases)
    string(REPLACE "\n" ";" cases "${cases}")
    foreach(case IN LISTS cases)
        list(APPEND names "${case}")
        list(APPEND "labels of ${case}" ${tag})
    endforeach()
endforeach()
list(REMOVE_DUPLICATES names)

set(script "")
foreach(case IN LISTS names)
    string(APPEND script "set_tests_properties([==[${PREFIX}${case}]==] PROPERTIES LABELS \"${labels of ${case}}\")\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
