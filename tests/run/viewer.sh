#!/usr/bin/env bash
# The viewer on a virtual display: it lights a file without light and says so, a recorded script gives the same picture
# again, keys work, and a session saved with F5 is the same scene for `render`; validation is silent.
source "$(dirname "${BASH_SOURCE[0]}")/display.sh"
cd "$work" || exit 1

fail() {
  echo "FAILED: $1"
  cat "$work/log"
  exit 1
}

press_when_open() {  # KEYS...
  await_window || fail "no window"
  xdotool mousemove --window "$window" 150 80
  for key in "$@"; do
    xdotool key "$key"
    sleep 0.2
  done
}

run() {  # WHAT CODE ARGUMENTS...
  local what=$1 expected=$2
  shift 2
  "$bin/afterglow" "$@" >"$work/log" 2>&1
  local code=$?
  [[ $code == "$expected" ]] || fail "$what: exit $code instead of $expected"
}

# A file without light or camera: both are chosen and said, and the picture is lit.
python3 - <<'PYTHON'
import base64, json, struct
corners = [-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1, -1, 2, -1, 1, 2, -1]
faces = [0, 1, 2, 0, 2, 3, 3, 2, 5, 3, 5, 4]
data = struct.pack("<18f12H", *corners, *faces)
json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_sheen": {}}}], "extensionsUsed": ["KHR_materials_sheen"],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 24}],
    "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]},
    open("dark.gltf", "w"))
PYTHON
run "a dark file" 0 view dark.gltf --size 160x90 --frames 40 --screenshot dark.png --validate
for words in "has no light: a sun is added" "has no sky: a clear one is added" "not supported: KHR_materials_sheen"; do
  grep -q "$words" "$work/log" || fail "nobody said '$words'"
done
run "its report" 0 info dark.gltf --json
grep -q '"support": "not supported"' "$work/log" || fail "the report says nothing of sheen"
run "a dark file by render" 0 render dark.gltf --preset afterglow --size 160x90 --frames 8 --set val_shading.glossy=off -o dark.exr
run "its truth" 0 reference dark.gltf --size 160x90 --bounces 1 --spp 64 --filter center -o truth.exr
run "both see the same from the same place" 0 compare truth.exr dark.exr --max-rel-rmse 0.15
run "the dark file from straight above" 0 reference dark.gltf --size 32x18 --spp 4 --view 0,5,0,0,0,0 -o above.exr

# Its session is the same light elsewhere.
"$bin/afterglow" view dark.gltf --size 160x90 --session dark.json --validate >"$work/log" 2>&1 &
viewer=$!
press_when_open F5 Escape
wait "$viewer" || fail "the viewer ended with $?"
run "the dark file's session" 0 render --session dark.json --size 160x90 --frames 8 -o dark_again.png
grep -q "is added" "$work/log" && fail "the session does not keep the light that was added"

# A script ends where it was recorded to: someone flies.
"$bin/afterglow" view cornell --size 160x90 --record flight.replay --screenshot flown.png --validate >"$work/log" 2>&1 &
viewer=$!
press_when_open Tab
xdotool keydown w
sleep 0.3
xdotool keyup w
xdotool key Escape Escape  # the camera lets go of the mouse, then the window closes
wait "$viewer" || fail "the recording viewer ended with $?"
frames=$(sed -n 's/^end //p' flight.replay)
run "a script" 0 view cornell --size 160x90 --frames "$frames" --script flight.replay --screenshot played.png --validate
run "no script" 0 view cornell --size 160x90 --frames 20 --screenshot still.png
cmp -s flown.png still.png && fail "W did not move the camera"
cmp -s flown.png played.png || fail "a script ends elsewhere than it was recorded to"

# Path tracing beside it: what it says is what `compare` says.
run "live truth" 0 view cornell --size 64x36 --frames 40 --truth live --truth-samples 16 --validate
cp "$work/log" said
run "its pictures" 0 compare live_1.exr live_2.exr live_ours.exr
for number in rel_rmse mean_ratio tone_rmse; do
  live=$(sed -n "s/^$number //p" said)
  compared=$(sed -n "s/.*\"$number\": \([^,]*\),*/\1/p" "$work/log")
  awk "BEGIN {exit !($live > 0 && ($live - $compared) ^ 2 <= (0.01 * $compared) ^ 2)}" ||
    fail "$number is $live in the viewer, $compared by compare"
done

# Keys: a layer, then the session is saved.
"$bin/afterglow" view cornell --size 320x180 --point 0.1,0.5,0.3,2,1,0.5 --session saved.json --set composite.exposure=1 --validate >"$work/log" 2>&1 &
viewer=$!
press_when_open 2 5 1 F2 F2 o o b b t t t p p F6 F5
for _ in $(seq 50); do
  [[ -f saved.json ]] && break
  sleep 0.2
done
xdotool key Escape
for _ in $(seq 100); do
  kill -0 "$viewer" 2>/dev/null || break
  sleep 0.2
done
kill -0 "$viewer" 2>/dev/null && { kill "$viewer"; fail "Esc did not close the viewer"; }
wait "$viewer" || fail "the viewer ended with $?"
[[ -f saved.json ]] || fail "F5 saved no session"

# The session is the same scene elsewhere: its light, its view, its settings.
run "the session" 0 render --session saved.json --size 64x36 --frames 8 --layer direct -o session.exr
run "the same by options" 0 render cornell --point 0.1,0.5,0.3,2,1,0.5 --size 64x36 --frames 8 --layer direct -o options.exr
run "the session is what was seen" 0 compare options.exr session.exr --max-rel-rmse 0.001
run "the scene as glTF" 0 render cornell_edited.glb --size 64x36 --frames 8 --layer direct -o edited.exr
run "the glTF is what was seen" 0 compare options.exr edited.exr --max-rel-rmse 0.01
run "a capture of the session" 0 capture --session saved.json --size 64x36 --frames 2 --warm-up 1 -o seen
grep -q "composite.exposure=1" seen/report.html || fail "the capture does not use the session's settings"

saved_number() {  # saves the session as FILE; what EXPRESSION of it, `d`, is
  rm -f "$1"
  xdotool key F5
  for _ in $(seq 150); do
    [[ -s $1 ]] && break
    sleep 0.2
  done
  python3 -c "import json; d = json.load(open('$1')); print($2)"
}
drag() {  # by 4 x PIXELS along x, undone, done again; READ says where it is: dragged, undone, again
  xdotool mousedown 1
  for _ in 1 2 3 4; do
    xdotool mousemove_relative -- "$1" 0
  done
  xdotool mouseup 1
  dragged=$("$2")
  xdotool key ctrl+z
  undone=$("$2")
  xdotool key ctrl+y
  again=$("$2")
}

# A lamp is dragged by its handle, which is undone and done again.
"$bin/afterglow" view cornell --size 640x360 --no-scene-lights --view 0,1,3.4,0,1,0,45 --point 1.5,1,0,3 --session drag.json \
  --preset afterglow --validate >"$work/log" 2>&1 &
viewer=$!
await_window || fail "no window to drag in"
lamp_at() {  # its x
  saved_number drag.json 'd["lights"][0]["position"][0] if "lights" in d else d["points"][0].split(",")[0]'
}
pixel=512  # 1.5 m to the right at 3.4 m: 320 + 1.5 * 180 / (3.4 * tan 22.5)
xdotool mousemove --window "$window" $pixel 180
drag -10 lamp_at
xdotool key Escape
wait "$viewer" || fail "the viewer ended with $?"
awk "BEGIN {exit !(($dragged - 1.187) ^ 2 < 0.0004 && ($undone - 1.5) ^ 2 < 1e-8 && $again == $dragged)}" ||
  fail "the lamp was dragged to $dragged, undone to $undone, done again to $again"

# A thing is picked and dragged by its handle, which is undone and done again; a material that a session changed stays so.
# Both come out of the session and of the edited file as the same picture.
python3 - <<'PYTHON'
import base64, json, struct
quad = [-0.3, -0.3, 0, 0.3, -0.3, 0, 0.3, 0.3, 0, -0.3, 0.3, 0]
data = struct.pack("<12f6H", *quad, 0, 1, 2, 0, 2, 3)
json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
    "nodes": [{"name": "stand", "translation": [0, 1, 0], "scale": [2, 2, 2], "children": [1]},
              {"name": "thing", "mesh": 0, "scale": [0.5, 0.5, 0.5]},
              {"name": "wall", "mesh": 1, "translation": [0, 1, -1], "scale": [8, 8, 8]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": m}]} for m in (0, 1)],
    "materials": [{"name": name, "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1}} for name in ("red", "white")],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]},
    open("thing.gltf", "w"))
json.dump({"scene": "thing.gltf", "preset": "afterglow", "set": ["exposure.automatic=off"], "points": ["1,2,2,5"],
    "view": "0,1,3.4,0,1,0,45", "materials": [{"material": 0, "base_color": [0.9, 0.1, 0.1, 1], "metallic": 0,
    "roughness": 0.8, "emissive": [0, 3, 0]}]}, open("thing.json", "w"))
PYTHON
"$bin/afterglow" view --session thing.json --size 640x360 --validate >"$work/log" 2>&1 &
viewer=$!
await_window || fail "no window to move a thing in"
moved_by() {  # how far along x
  saved_number thing.json 'sum(m["offset"][0] for m in d.get("moves", []))'
}
xdotool mousemove --window "$window" 320 180
[[ $(moved_by) == 0 ]] || fail "the thing does not stand still"
xdotool click 1
drag 10 moved_by
xdotool key F6 Escape
wait "$viewer" || fail "the viewer ended with $?"
awk "BEGIN {exit !(($dragged - 0.313) ^ 2 < 0.0004 && $undone == 0 && $again == $dragged)}" ||
  fail "the thing was dragged by $dragged, undone to $undone, done again to $again"
run "the thing's session" 0 render --session thing.json --size 64x36 --frames 8 --layer radiance -o session.exr
run "the thing's file" 0 render thing_edited.gltf --preset afterglow --size 64x36 --frames 8 --layer radiance -o edited.exr
run "both are the same" 0 compare session.exr edited.exr --max-rel-rmse 0.01
run "the thing as it was" 0 render thing.gltf --preset afterglow --point 1,2,2,5 --view 0,1,3.4,0,1,0,45 --size 64x36 --frames 8 --layer radiance -o was.exr
run "something changed" 1 compare was.exr session.exr --max-rel-rmse 0.05
run "a bench of the session" 0 bench --session thing.json --size 64x36 --frames 2 --reference-spp 8 --clusterings 1 --no-flicker --no-path-tracing --csv bench.csv
grep -q "^thing.json,session," bench.csv || fail "the bench has no row of the session"

# Lines in the world, all panels, the whole monitor, a capture: and it is remembered.
"$bin/afterglow" view cornell --size 640x360 --sun 0.3,-1,-0.2,5 --validate >"$work/log" 2>&1 &
viewer=$!
press_when_open v F1 F2 F9 F11 F11 F10
for _ in $(seq 300); do
  compgen -G "captures/*/report.html" >/dev/null && break
  sleep 0.2
done
xdotool key Escape
wait "$viewer" || fail "the viewer with everything open ended with $?"
report=$(compgen -G "captures/*/report.html") || fail "F10 left no report"
grep -q "saves about" "$report" || fail "the report advises nothing"
for line in "area_lights on" "settings on" "passes on" "profiler on" "fullscreen off"; do
  grep -q "^$line" "$XDG_CONFIG_HOME/afterglow/viewer.txt" || fail "'$line' is not remembered"
done

# Every field of a light is kept, and the eye and the camera as they were.
cat >hand.json <<'JSON'
{"scene": "cornell", "preset": "afterglow", "set": ["exposure.automatic=off"],
 "camera": {"position": [0, 1, 0.9], "forward": [0, -1, 0], "up": [0, 0, -1], "vertical_fov": 0.9, "near": 0.3},
 "lights": [{"kind": "spot", "position": [0, 1.9, 0], "direction": [0, -1, 0], "intensity": [3, 3, 3], "range": 1.5,
   "inner_cone": 0, "outer_cone": 1.5707963705062866, "bounces": true, "casts_shadow": false}]}
JSON
cp hand.json again.json
"$bin/afterglow" view --session again.json --size 160x90 --point 5,5,5,0.001 --validate >"$work/log" 2>&1 &
viewer=$!
press_when_open F5 Escape
wait "$viewer" || fail "the viewer of a session by hand ended with $?"
python3 - <<'PYTHON' || fail "the session is not what it was: $(cat again.json)"
import json
a, b = json.load(open("hand.json")), json.load(open("again.json"))
same = lambda x, y: x == y or all(abs(i - j) < 1e-6 for i, j in zip(x, y)) if isinstance(x, list) else x == y or abs(x - y) < 1e-6
assert all(same(a["camera"][k], b["camera"][k]) for k in a["camera"]), "camera"
assert all(same(v, b["lights"][0][k]) for k, v in a["lights"][0].items() if k != "kind"), "lights"
assert not any("automatic=on" in s or "tonemap" in s for s in b["set"]), "set"
PYTHON
run "the session by hand" 0 render --session again.json --size 64x36 --frames 4 -o hand.exr
sed 's/"spot"/"moon"/' hand.json >broken.json
run "a light of no kind" 2 render --session broken.json -o x.png
sed 's/"forward": .0, -1, 0./"forward": [0, 0, 0]/' hand.json >broken.json
run "a camera that looks nowhere" 2 render --session broken.json -o x.png
echo '{"scene": 3}' >broken.json
run "a broken session" 2 render --session broken.json -o x.png
run "a session that is none" 2 view --session dark.png
run "no scene" 2 view
echo "passed"
