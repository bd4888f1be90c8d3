-- The build description. Works with premake5 (premake5 gmake) and Debian's premake4 4.3 (premake4 --file=premake5.lua gmake).
-- One project per part of the tree; each test_*.c under tests/ is a program of its own. Run through ./nook, which
-- regenerates this when the list of files or flags changes.

if not workspace then -- premake4: give it the premake5 names used below
  workspace = solution
  function filter(terms)
    if type(terms) == "string" then terms = { terms } end
    local out = {}
    for _, term in ipairs(terms) do
      local negated, rest = term:match("^(not%s+)(.*)$")
      term = rest or term
      local _, value = term:match("^(%a+):(.*)$")
      table.insert(out, (negated or "") .. (value or term))
    end
    configuration(out)
  end
  function cdialect(v) buildoptions { "-std=" .. v:lower() } end
  function cppdialect(v) buildoptions { "-std=" .. v:lower():gsub("c%+%+", "c++") } end
  function symbols(v) if v == "On" then flags { "Symbols" } end end
  function optimize(v) if v ~= "Off" then flags { "OptimizeSpeed" } end end
  function pic() buildoptions { "-fPIC" } end
end

newoption { trigger = "sanitize", description = "build with AddressSanitizer and UndefinedBehaviorSanitizer" }

local out = _OPTIONS["sanitize"] and "build/sanitize" or "build/release"

workspace "nook"
  configurations { "Release" }
  location(out)
  targetdir(out .. "/bin")
  includedirs { "." }
  defines { "_DEFAULT_SOURCE", "CGLM_ALL_UNALIGNED" }
  pic "On"
  symbols "On"
  optimize "Speed"
  -- Strict floating point: measured results must not depend on contraction into fused multiply-adds.
  buildoptions { "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off", "-fno-omit-frame-pointer", "-pthread" }
  linkoptions { "-pthread" }
  if _OPTIONS["sanitize"] then
    buildoptions { "-fsanitize=address,undefined", "-fno-sanitize-recover=all" }
    linkoptions { "-fsanitize=address,undefined" }
  end

local function c_project(name, project_kind)
  project(name)
  kind(project_kind)
  language "C"
  cdialect "C11"
  buildoptions { "-Wshadow", "-Wconversion", "-Wstrict-prototypes", "-Wmissing-prototypes" }
  objdir(out .. "/obj/" .. name)
end

local function c_library(name, folders)
  c_project(name, "StaticLib")
  for _, folder in ipairs(folders) do files { folder .. "/**.c", folder .. "/**.h", folder .. "/**.inl", folder .. "/**.def" } end
end

-- Parts, lowest first; a part links what stands below it (docs/architecture.md).
c_library("nook_core", { "engine/core" })
c_library("nook_platform", { "engine/platform" })
c_library("nook_gpu", { "engine/gpu" })
c_library("nook_ecs", { "engine/ecs" })
c_library("nook_asset", { "engine/asset" })
c_library("nook_bake", { "modules/bake" })
c_library("nook_ao", { "modules/ao" })
for _, folder in ipairs(os.matchdirs("modules/ao_*")) do
  c_library("nook_" .. path.getname(folder), { folder })
end
c_library("nook_measure", { "modules/measure" })
c_library("nook_render", { "engine/render" })

project "nook_gltf" -- the C++ shim around tinygltf, behind a C header
  kind "StaticLib"
  language "C++"
  cppdialect "C++17"
  objdir(out .. "/obj/nook_gltf")
  files { "engine/asset/**.cpp" }

local function nook_links()
  links { "nook_render", "nook_measure" }
  for _, folder in ipairs(os.matchdirs("modules/ao_*")) do links { "nook_" .. path.getname(folder) } end
  links { "nook_ao", "nook_bake", "nook_asset", "nook_gltf", "nook_ecs", "nook_gpu", "nook_platform", "nook_core",
          "tinygltf", "stb", "embree3", "glfw", "EGL", "teem", "zstd", "xxhash", "stdc++", "dl", "m" }
end

c_library("nook_game", { "game" })
  removefiles = removefiles or excludes
  removefiles { "game/main.c" }

c_project("nook", "ConsoleApp")
  files { "game/main.c" }
  links { "nook_game" }
  nook_links()

c_library("nook_testing", { "tests/support" })

for _, file in ipairs(os.matchfiles("tests/**.c")) do
  local name = path.getbasename(file)
  if name:match("^test_") then
    c_project(name, "ConsoleApp")
    targetdir(out .. "/tests")
    files { file }
    links { "nook_testing", "nook_game" }
    nook_links()
    links { "cmocka" }
  end
end
