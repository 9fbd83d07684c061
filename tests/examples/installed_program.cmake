# The installed program finds its modules when its tree was moved: reading a PNG needs one.
file(REMOVE_RECURSE ${WORK})
file(COPY ${PREFIX}/ DESTINATION ${WORK}/moved)
set(png "${WORK}/grey.png")
# A picture of 2 x 1 texels, 8 bits of grey.
execute_process(COMMAND base64 -d OUTPUT_FILE ${png} COMMAND_ERROR_IS_FATAL ANY INPUT_FILE ${CMAKE_CURRENT_LIST_DIR}/grey.png.base64)
execute_process(COMMAND ${WORK}/moved/${BINDIR}/pbrbake probe ${png} --size 8 --levels 1 --quiet -o ${WORK}/grey.exr
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS ${WORK}/grey.exr.json OR NOT EXISTS ${WORK}/moved/share/pbrbake/schemas/job.schema.json)
    message(FATAL_ERROR "product or schemas are missing")
endif()
