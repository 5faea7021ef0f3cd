# The word of standard input with the smallest edit distance to the variable `word`.
function distance(a, b,    i, j, d, substituted) {
  for (i = 0; i <= length(a); ++i) d[i, 0] = i
  for (j = 0; j <= length(b); ++j) d[0, j] = j
  for (i = 1; i <= length(a); ++i)
    for (j = 1; j <= length(b); ++j) {
      substituted = d[i - 1, j - 1] + (substr(a, i, 1) != substr(b, j, 1))
      d[i, j] = d[i - 1, j] + 1
      if (d[i, j - 1] + 1 < d[i, j]) d[i, j] = d[i, j - 1] + 1
      if (substituted < d[i, j]) d[i, j] = substituted
    }
  return d[length(a), length(b)]
}
{
  now = distance(word, $1)
  if (NR == 1 || now < best) { best = now; nearest = $1 }
}
END { print nearest }
