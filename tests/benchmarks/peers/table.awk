# One Markdown table and what follows from it, of the lines that trial.hpp describes; mode: none or
# factors.
function mark(s) { if (!(s in sets)) { sets[s]; set_order[++set_count] = s } }

# Adds a problem to the geometric mean of one kind of peers.
function add(kind, s, ratio) {
  sum[kind, s] += log(ratio); count[kind, s]++
  sum[kind, "all"] += log(ratio); count[kind, "all"]++
}

function print_means(kind, title,    i, s) {
  if (!count[kind, "all"]) return
  printf "Evaluations over %s, geometric mean:", title
  for (i = 1; i <= set_count; i++) {
    s = set_order[i]
    if (count[kind, s]) {
      printf " %s %.2f (of %d);", s, exp(sum[kind, s] / count[kind, s]), count[kind, s]
    }
  }
  printf " all %.2f (of %d)\n\n", exp(sum[kind, "all"] / count[kind, "all"]), count[kind, "all"]
}

$3 != mode { next }
{
  problem = $1
  if (!(problem in set)) { set[problem] = $2; order[++problems] = problem; mark($2); of[$2]++ }
  if (!($4 in tried)) { tried[$4]; solvers[++solver_count] = $4 }
  solved[$4, $2] += $6
  solved[$4, "all"] += $6
}
$4 == "libjfnk" {
  mine[problem] = $6 ? $7 : "-"
  ms[problem] = $8
  if ($5 && !$6) { mine[problem] = "FALSE"; false_successes++ }
  purposes[problem] = $9
  next
}
$6 && !(problem in best) { solved["any peer", $2]++; solved["any peer", "all"]++ }
$6 && (!(problem in best) || $7 < best[problem]) {
  best[problem] = $7; by[problem] = $4; best_ms[problem] = $8
}
$6 && $4 !~ /Anderson/ && (!(problem in nk) || $7 < nk[problem]) { nk[problem] = $7 }
END {
  print mode == "none" ? "## Without preconditioner" : "## Factors of the Jacobian at the start"
  print ""
  print "| problem | set | libjfnk | ms | of which | best peer | ms | ratio | by |"
  print "|---|---|---|---|---|---|---|---|---|"
  for (i = 1; i <= problems; i++) {
    p = order[i]
    ratio = "-"
    both = (p in best) && mine[p] ~ /^[0-9]+$/
    if (both) { ratio = sprintf("%.2f", mine[p] / best[p]); add("any", set[p], mine[p] / best[p]) }
    if (both && (p in nk)) add("nk", set[p], mine[p] / nk[p])
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", p, set[p], mine[p], ms[p], \
      purposes[p], (p in best) ? best[p] : "-", (p in best) ? best_ms[p] : "-", ratio, \
      (p in by) ? by[p] : "-"
  }
  print ""
  print_means("any", "those of the best peer of each problem")
  print_means("nk", "those of the best Newton-Krylov peer (no Anderson)")
  header = "| solved by"; line = "|---"
  for (j = 1; j <= set_count; j++) {
    header = header " | " set_order[j] ", of " of[set_order[j]]; line = line "|---"
  }
  print header " | all, of " problems " |"
  print line "|---|"
  solvers[++solver_count] = "any peer"
  for (i = 1; i <= solver_count; i++) {
    row = "| " solvers[i]
    for (j = 1; j <= set_count; j++) row = row " | " solved[solvers[i], set_order[j]] + 0
    print row " | " solved[solvers[i], "all"] + 0 " |"
  }
  printf "\nFalse successes of libjfnk: %d\n\n", false_successes
}
