# Run by `cmake --install`: asks PROGRAM for its manual and completions, STRESS_PROGRAM for its manual, keeps them in MADE_FOLDER, installs them.
#
# Debian's zsh looks for what packages bring in vendor-completions, and for what an administrator brings in site-functions.
set(ZSH_FOLDER share/zsh/site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(ZSH_FOLDER share/zsh/vendor-completions)
endif()

# Of what ASKED prints.
function(install_made FOLDER NAME ASKED)
  file(MAKE_DIRECTORY ${MADE_FOLDER}/${FOLDER})
  execute_process(COMMAND ${ASKED} ${ARGN} OUTPUT_FILE ${MADE_FOLDER}/${FOLDER}/${NAME} COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/${FOLDER} TYPE FILE FILES ${MADE_FOLDER}/${FOLDER}/${NAME})
endfunction()

install_made(share/man/man1 parhelion.1 ${PROGRAM} man)
install_made(share/man/man1 parhelion-stress.1 ${STRESS_PROGRAM} man)
install_made(share/bash-completion/completions parhelion ${PROGRAM} completion bash)
install_made(${ZSH_FOLDER} _parhelion ${PROGRAM} completion zsh)
