-- The build description. Works with premake5 (premake5 gmake) and Debian's premake4 4.3 (premake4 --file=premake5.lua gmake).
-- One project per part of the tree; each tests/**/test_*.c is a program of its own. Run it through ./nook, which regenerates
-- when the list of files changes and starts clean when flags do: neither premake rebuilds objects for changed flags.

if not workspace then -- premake4: give it the premake5 names used below
  workspace = solution
  removefiles = excludes
  function cdialect(v) buildoptions { "-std=" .. v:lower() } end
  function cppdialect(v) buildoptions { "-std=" .. v:lower() } end
  function symbols(v) flags { "Symbols" } end
  function optimize(v) if v == "Speed" then flags { "OptimizeSpeed" } end end
  function pic(v) buildoptions { "-fPIC" } end
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
  -- Strict floating point: measured results must not depend on contraction into fused multiply-adds.
  buildoptions { "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off", "-fno-omit-frame-pointer", "-pthread" }
  linkoptions { "-pthread" }
  if _OPTIONS["sanitize"] then
    optimize "Off"
    buildoptions { "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all" }
    linkoptions { "-fsanitize=address,undefined" }
  else
    optimize "Speed"
  end

-- premake4 maps two sources of one name to one object and drops one silently.
local function check_names(name, sources)
  local seen = {}
  for _, source in ipairs(sources) do
    local base = path.getbasename(source)
    if seen[base] then error(name .. ": " .. seen[base] .. " and " .. source .. " need different names", 0) end
    seen[base] = source
  end
end

local function c_project(name, project_kind)
  project(name)
  kind(project_kind)
  language "C"
  cdialect "C11"
  buildoptions { "-Wshadow", "-Wconversion", "-Wstrict-prototypes", "-Wmissing-prototypes" }
  objdir(out .. "/obj/" .. name)
end

local function cpp_project(name, project_kind)
  project(name)
  kind(project_kind)
  language "C++"
  cppdialect "C++17"
  objdir(out .. "/obj/" .. name)
end

local libraries = {} -- names in link order: what uses stands before what is used

-- pattern: "/**.c" is the folder with all below it, "/*.c" without. A folder without sources (headers only, or not written yet) makes no library and is not linked.
local engine, shared = {}, {} -- archives of engine/, and those of game/ and modules/ but for the techniques', in link order

local function library(name, make_project, folder, pattern)
  local sources = os.matchfiles(folder .. pattern)
  if #sources == 0 then return end
  check_names(name, sources)
  make_project(name, "StaticLib")
  files { folder .. pattern }
  table.insert(libraries, 1, name)
  if not folder:match("^modules/ao_") then table.insert(folder:match("^engine/") and engine or shared, 1, name) end
end

-- Parts, lowest first; a part uses only what stands above it here (docs/architecture.md).
library("nook_core", c_project, "engine/core", "/**.c")
library("nook_platform", c_project, "engine/platform", "/**.c")
library("nook_module", c_project, "engine/module", "/**.c")
library("nook_gpu", c_project, "engine/gpu", "/**.c")
library("nook_ecs", c_project, "engine/ecs", "/**.c")
library("nook_physics", c_project, "engine/physics", "/**.c")
library("nook_gltf", cpp_project, "engine/asset", "/**.cpp") -- the shim around tinygltf, behind a C header
library("nook_asset", c_project, "engine/asset", "/**.c")
library("nook_animation", c_project, "engine/animation", "/**.c")
library("nook_overlay", c_project, "engine/overlay", "/**.c")
library("nook_imgui", cpp_project, "engine/overlay", "/**.cpp") -- the shim around Dear ImGui, behind the overlay's header
library("nook_bake", c_project, "modules/bake", "/**.c")
library("nook_ao", c_project, "modules/ao", "/*.c")
library("nook_stream", c_project, "modules/stream", "/**.c")
library("nook_ao_ecs", c_project, "modules/ao/ecs", "/**.c") -- joins the two: the core itself knows no ECS
library("nook_trace", c_project, "modules/trace", "/**.c")
local techniques = os.matchdirs("modules/ao_*")
table.sort(techniques)
for _, folder in ipairs(techniques) do library("nook_" .. path.getname(folder), c_project, folder, "/**.c") end
library("nook_fixture", c_project, "modules/fixture", "/**.c")
library("nook_measure", c_project, "modules/measure", "/**.c")
library("nook_plan", c_project, "modules/plan", "/**.c")
library("nook_render", c_project, "engine/render", "/**.c")
library("nook_game", c_project, "game", "/**.c")
removefiles { "game/main.c", "game/entry/*.c" } -- of nook_game, the last project made

local function link_everything()
  links(libraries)
  links { "tinygltf", "imgui", "stb", "embree3", "glfw", "uv", "ode", "zstd", "xxhash", "z", "bz2", "stdc++", "dl", "m" }
end

-- Shared libraries find the engine in the program that loads them: all of it is there, and its names can be seen.
local function export_engine()
  linkoptions { "-rdynamic", "-Wl,--push-state,--whole-archive" }
  for _, name in ipairs(engine) do linkoptions { "bin/lib" .. name .. ".a" } end
  linkoptions { "-Wl,--pop-state" }
end

c_project("nook", "ConsoleApp")
files { "game/main.c" }
export_engine()
linkoptions { "-Wl,--disable-new-dtags", "-Wl,-rpath,'$$ORIGIN/lib'" } -- of a bundle; these libraries find each other there, too
link_everything()

-- Code that is exchanged while it runs (engine/module): what the program has linked in, once more as a shared library. Same
-- objects; only the entry is compiled, and seen from outside.
local function exchangeable(name, entry, archives)
  if #os.matchfiles(entry) == 0 then return end
  c_project(name, "SharedLib")
  targetprefix ""
  files { entry }
  linkoptions { "-Wl,-Bsymbolic", "-Wl,--exclude-libs,ALL" }
  links(archives)
end

-- The game has none of the techniques' code: each comes from its own library, and a change of one changes no other.
exchangeable("game", "game/entry/game_entry.c", shared)
for _, folder in ipairs(techniques) do
  local name = path.getname(folder)
  exchangeable(name, "modules/ao/entry/technique_entry.c", { "nook_" .. name, "nook_trace", "nook_ao" })
  defines { "NOOK_TECHNIQUE=" .. name:match("^ao_(.*)") }
end

library("nook_testing", c_project, "tests/support", "/**.c")

local tests = os.matchfiles("tests/**.c")
table.sort(tests)
for _, file in ipairs(tests) do
  local folder, subject = file:match("^tests/(.*)test_([^/]*)%.c$")
  if subject and folder ~= "support/" then -- tests/core/test_file.c is the program tests/test_core_file
    c_project("test_" .. folder:gsub("/", "_") .. subject, "ConsoleApp")
    targetdir(out .. "/tests")
    files { file }
    if folder == "module/" then export_engine() end
    if folder == "embed/" then -- a host of the AO core alone: that this links is a part of the test
      links { "nook_ao_volume", "nook_ao_ssao", "nook_ao", "nook_bake", "nook_gpu", "nook_core", "zstd", "xxhash", "dl", "m" }
    else
      link_everything()
    end
    links { "cmocka" }
  end
end
