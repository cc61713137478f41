#!/usr/bin/env bash
# A capture's report in a browser without a network: it loads without an error, the table sorts, the slider moves,
# a frame can be chosen.
set -u
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v chromium >/dev/null || { echo "FAILED: chromium is missing (see tools/test_packages.txt)"; exit 1; }
"$bin/afterglow" capture cornell -o "$work/seen" --size 64x36 --frames 4 --warm-up 3 --schedule --walk 0.01,0,0 \
  --reference --reference-spp 4 >/dev/null 2>"$work/err" || { echo "FAILED: capture: $(cat "$work/err")"; exit 1; }

# Ahead of the page: what goes wrong, also loads from outside. After it: what a reader does.
cat >"$work/before.html" <<'HTML'
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<script>
const wrong = [];
addEventListener('error', e => wrong.push(e.message || 'an element failed to load'), true);
addEventListener('securitypolicyviolation', e => wrong.push('asks for ' + e.blockedURI));
console.error = text => wrong.push(text);
</script>
HTML
cat >"$work/after.html" <<'HTML'
<script>
addEventListener('load', () => {
  const expect = (what, words) => { if (!what) wrong.push(words); };
  const cells = i => [...document.querySelectorAll('#rows tr')].map(r => r.children[i].textContent);
  const numbers = i => cells(i).map(t => Number(t.replaceAll(',', '')));
  const headers = document.querySelectorAll('th'), count = cells(0).length;
  expect(count > 30, 'the table is short');
  expect(numbers(1).every((v, i, all) => i === 0 || all[i - 1] >= v), 'times do not fall at first');
  headers[1].click();
  expect(numbers(1).every((v, i, all) => i === 0 || all[i - 1] <= v), 'times do not rise');
  headers[1].click();
  expect(numbers(1).every((v, i, all) => i === 0 || all[i - 1] >= v), 'times do not fall');
  headers[0].click();
  expect(cells(0).every((v, i, all) => i === 0 || all[i - 1].localeCompare(v) <= 0), 'names are not in order');
  expect(cells(0).length === count, 'sorting lost rows');

  const slider = document.getElementById('slider'), box = slider.getBoundingClientRect();
  const move = share => slider.dispatchEvent(new PointerEvent('pointermove',
    { pointerType: 'mouse', buttons: 1, clientX: box.left + box.width * share }));
  const at = () => document.getElementById('line').getBoundingClientRect().left - box.left;
  move(0.25);
  expect(Math.abs(at() - box.width * 0.25) < 2, 'the line did not follow to a quarter');
  move(0.75);
  expect(Math.abs(at() - box.width * 0.75) < 2, 'the line did not follow to three quarters');
  expect(document.getElementById('over').style.clipPath.startsWith('inset(0px 25'), 'the left picture is not cut');
  expect(document.getElementById('right').selectedOptions[0].text === 'reference', 'the reference is not offered');
  expect([...document.images].every(i => i.complete && i.naturalWidth > 0), 'a picture is broken');

  const list = id => [...document.querySelectorAll('#' + id + ' li')].map(e => e.textContent);
  expect(list('advice').some(t => /^[a-z_.]+=\S+ \(now .*\) saves about .* ms .*error/.test(t)), 'no setting is advised: ' + list('advice'));
  expect(list('anew').some(t => t.includes('the camera moved')), 'nobody says that the camera moved');
  expect(list('gaps').length > 0, 'nothing is said of gaps');

  const before = document.getElementById('which').textContent;
  document.querySelectorAll('#strip div')[0].click();
  expect(document.getElementById('which').textContent !== before, 'no other frame was chosen');
  expect(document.querySelectorAll('#gantt i').length > 20, 'the frame has no bars');
  expect(document.querySelectorAll('svg rect').length > count, 'the graph is not there');
  document.title = wrong.length ? 'WRONG: ' + wrong.join('; ') : 'ALL RIGHT';
});
</script>
HTML
{ echo '<!doctype html>'; cat "$work/before.html"; tail -n +2 "$work/seen/report.html"; cat "$work/after.html"; } >"$work/page.html"
root=()
[[ $(id -u) == 0 ]] && root=(--no-sandbox)  # the browser refuses its sandbox to root
timeout 120 chromium --headless "${root[@]}" --disable-gpu --user-data-dir="$work/profile" --window-size=1280,900 \
  --dump-dom "file://$work/page.html" >"$work/dom" 2>/dev/null
title=$(grep -o '<title>[^<]*' "$work/dom" | head -1)
[[ $title == "<title>ALL RIGHT" ]] || { echo "FAILED: $title"; exit 1; }
