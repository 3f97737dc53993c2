# Writes OUTPUT with the version and the commit of SOURCE ("unknown" outside a checkout, "+" with changes).
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
    set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#pragma once
#define CAISSON_VERSION \"@VERSION@\"
#define CAISSON_COMMIT \"@commit@\"
" @ONLY)
