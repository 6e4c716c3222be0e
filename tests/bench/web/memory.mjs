// SPDX-License-Identifier: Apache-2.0
import {readdirSync, readFileSync} from 'node:fs';

function childrenOf(pid) {
  return readdirSync('/proc').filter((name) => {
    if (!/^\d+$/.test(name)) return false;
    try {
      const stat = readFileSync(`/proc/${name}/stat`, 'utf8');
      return Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[1]) === pid;
    } catch {
      return false;
    }
  }).map(Number);
}

/** Megabytes (proportional set sizes) of the browser's processes below this one: all of them, and the one that draws. */
export function memoryUnder(pid) {
  let total = 0;
  let gpu = 0;
  const add = (process) => {
    try {
      const command = readFileSync(`/proc/${process}/cmdline`, 'utf8');
      const size = Number(/Pss:\s+(\d+)/.exec(readFileSync(`/proc/${process}/smaps_rollup`, 'utf8'))[1]) / 1024;
      total += size;
      if (command.includes('--type=gpu-process')) gpu += size;
    } catch {
      // ended meanwhile
    }
    childrenOf(process).forEach(add);
  };
  childrenOf(pid).forEach(add);
  return {memory_mb: Math.round(total), gpu_process_mb: Math.round(gpu)};
}

/** Milliseconds of processor time that the drawing process below this one has taken: unlike frames a second, the same on a busy machine. */
export function drawingTimeUnder(pid) {
  const tick = 10; // milliseconds of a clock tick
  let sum = 0;
  const add = (process) => {
    try {
      const stat = readFileSync(`/proc/${process}/stat`, 'utf8');
      const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
      if (readFileSync(`/proc/${process}/cmdline`, 'utf8').includes('--type=gpu-process')) sum += tick * (Number(fields[11]) + Number(fields[12]));
    } catch {
      // ended meanwhile
    }
    childrenOf(process).forEach(add);
  };
  childrenOf(pid).forEach(add);
  return sum;
}
