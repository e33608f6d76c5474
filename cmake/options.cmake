# SPDX-License-Identifier: GPL-3.0-or-later
# What every target is compiled with.
add_library(gf_options INTERFACE)
target_include_directories(gf_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(gf_options INTERFACE "$<$<CONFIG:Debug>:GF_DEBUG;_GLIBCXX_ASSERTIONS>")

# Same bits everywhere: no contraction to fused multiply-add, no reassociation. sqrt need not set errno, so that it is
# one instruction.
set(GF_HOST_FLAGS -ffp-contract=off -fno-math-errno -fno-trapping-math)
set(GF_WARNINGS -Wall -Wextra -Werror -Wshadow -Wpedantic -Wno-error=deprecated-declarations)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    list(APPEND GF_WARNINGS -Wno-restrict)  # false alarm on "literal" + std::string, gcc bug 105651
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    list(REMOVE_ITEM GF_HOST_FLAGS -fno-trapping-math)  # clang 14 has no such default; the flag changes nothing there
endif()
target_compile_options(gf_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:${GF_HOST_FLAGS};${GF_WARNINGS}>)

if(GF_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        message(FATAL_ERROR "GF_FUZZ needs clang: gcc has no -fsanitize=fuzzer")
    endif()
    set(GF_SANITIZE address,undefined,float-cast-overflow,fuzzer-no-link)
endif()
if(GF_SANITIZE)
    # Not the checks of every pointer that is followed (null, misaligned, of another type): a third of the build's time. A
    # null pointer crashes with a trace all the same.
    target_compile_options(gf_options INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${GF_SANITIZE};-fno-sanitize=null,alignment,object-size,vptr>
        $<$<COMPILE_LANGUAGE:CXX>:-fno-omit-frame-pointer;-fno-sanitize-recover=all>)
    target_link_options(gf_options INTERFACE -fsanitize=${GF_SANITIZE})
endif()

find_package(Threads REQUIRED)
target_link_libraries(gf_options INTERFACE Threads::Threads)
