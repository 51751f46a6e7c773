# Writes TEXTS to OUTPUT as pairs of a name, as it is included, and a raw string literal:
# cmake -DTEXTS=... -DFOLDERS=... -DOUTPUT=... -P embed_texts.cmake. A text's name is its path below one of FOLDERS.
set(pairs "")
foreach(path ${TEXTS})
  set(name ${path})
  foreach(folder ${FOLDERS})
    string(REPLACE "${folder}/" "" name ${name})
  endforeach()
  file(READ ${path} text)
  string(APPEND pairs "{\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE ${OUTPUT} "${pairs}")
