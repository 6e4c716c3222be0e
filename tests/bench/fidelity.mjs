// SPDX-License-Identifier: Apache-2.0
// How well written skies show their models: builds each real file of ../shared/data and looks at what was written with
// `cloudgen verify`. One JSON line a case; a table at the end.
//   node tests/bench/fidelity.mjs CLOUDGEN [--files REGEX] [--budgets 20000,200000,2000000] [--seeds 1,2,3,4,5] [--formats x3d,splats]
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

const { values: options, positionals: [cloudgen] } = parseArgs({
  allowPositionals: true,
  options: {
    files: { type: 'string', default: '.' },
    budgets: { type: 'string', default: '20000,200000,2000000' },
    seeds: { type: 'string', default: '1,2,3,4,5' },
    formats: { type: 'string', default: 'x3d,splats' },
    data: { type: 'string', default: new URL('../../../shared/data', import.meta.url).pathname },
  },
});

/** A regional box of each file that has levels; null: all of it. */
const inputs = [
  ['gfs_2p5_20110110_f120.grib2', '-100,25,-60,50'],
  ['wrfout_katrina_mercator_20050828.nc', null],
  ['era5_cirrus_16x8x4x13.nc', null],
  ['gfs_icmr_17x17x3x7.nc', null],
  ['eta_g211_lambert_20041208_f24.grib2', '-100,30,-75,45'],
  ['ruc13_g212_2005080700_f00.grb', '-100,30,-85,42'],
  ['ruc13_g212_2005080700_f12.grb', '-100,30,-85,42'],
  ['ruc13_g212_2005080700_f24.grb', '-100,30,-85,42'],
  ['wafs_thinned_reduced_ll_20070110.grib2', '-60,10,-30,40'],
  ['ifs_oper_20240101_10msgs.grib2', '0,40,15,52'],
  ['icon_ny-alesund_column_20210104.nc', null],
];

function ran(words) {
  const started = Date.now();
  const { status, stdout, stderr } = spawnSync(cloudgen, words, { encoding: 'utf8', maxBuffer: 1 << 28 });
  return { status, stdout, stderr, seconds: (Date.now() - started) / 1000 };
}

const rounded = (value, digits) => (value === null ? null : Number(value.toFixed(digits)));

function measure(file, box, budget, seed, folder) {
  const out = join(folder, 'scene'), input = join(options.data, file);
  rmSync(out, { recursive: true, force: true });
  const built = ran(['build', input, '-o', out, '--formats', options.formats, '--max-puffs', budget, '--seed', seed, '--json',
                     ...(box ? [`--bbox=${box}`] : [])]);
  if (built.status !== 0) throw new Error(`build of ${file}: ${built.stderr}`);
  const { counts } = JSON.parse(built.stdout);
  return options.formats.split(',').map((format) => {
    const looked = ran(['verify', out, '--against', input, '--format', format, '--json', '--no-maps']);
    const told = JSON.parse(looked.stdout);
    const cover = Object.fromEntries(['total', 'low', 'middle', 'high'].map((range) =>
      [range, [rounded(told.cover[range].bias, 4), rounded(told.cover[range].rmse, 4)]]));
    return {
      bench: 'fidelity', file, format, budget: Number(budget), seed: Number(seed), columns: told.columns, clouds: counts.clouds, puffs: counts.puffs,
      cover, tau_bias: rounded(told.optical_depth.bias_relative, 4), tau_r: rounded(told.optical_depth.correlation, 4),
      base_rmse_m: rounded(told.base_m.rmse, 0), top_rmse_m: rounded(told.top_m.rmse, 0),
      build_s: built.seconds, verify_s: looked.seconds, passed: told.passed, broken: told.broken.map((one) => one.measure),
    };
  });
}

if (!cloudgen) {
  console.error('usage: node tests/bench/fidelity.mjs CLOUDGEN [--files REGEX] [--budgets N,N] [--seeds N,N] [--formats x3d,splats]');
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), 'fidelity-'));
const rows = [];
try {
  for (const [file, box] of inputs.filter(([name]) => new RegExp(options.files).test(name))) {
    if (!existsSync(join(options.data, file))) { console.error(`skipped: ${file} is not in ${options.data}`); continue; }
    for (const budget of options.budgets.split(','))
      for (const seed of options.seeds.split(','))
        for (const row of measure(file, box, budget, seed, folder)) {
          console.log(JSON.stringify(row));
          rows.push(row);
        }
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
console.error('| file | format | budget | runs | passed | worst cover bias | worst cover rmse | tau bias | least r | base m | top m |\n' +
              '|---|---|---|---|---|---|---|---|---|---|---|');
for (const [key, group] of grouped(rows)) {
  const worst = (pick) => Math.max(...group.map((row) => Math.abs(pick(row) ?? 0)));
  const rs = group.map((row) => row.tau_r).filter((r) => r !== null);
  console.error(`| ${key} | ${group.length} | ${group.filter((row) => row.passed).length} | ` +
                `${worst((row) => row.cover.total[0])} | ${worst((row) => row.cover.total[1])} | ${worst((row) => row.tau_bias)} | ` +
                `${rs.length ? Math.min(...rs) : '-'} | ${worst((row) => row.base_rmse_m)} | ${worst((row) => row.top_rmse_m)} |`);
}

function groupOf(row) { return `${row.file.slice(0, 14)} | ${row.format} | ${row.budget}`; }
function grouped(all) {
  const groups = new Map();
  for (const row of all) groups.set(groupOf(row), [...(groups.get(groupOf(row)) ?? []), row]);
  return groups;
}
