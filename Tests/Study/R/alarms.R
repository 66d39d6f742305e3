# SPDX-License-Identifier: MIT
# Rscript alarms.R ANALYSIS.R [RUNS [STUDIES]]: how often analysis.R finds what is not there, in designs of observers whom no condition moves on average, and
# how often its 95 % intervals of a difference hold. Every night. Exit code 1 beyond chance, by three standard errors.
words <- commandArgs(TRUE); runs <- as.integer(c(words[-1], 300)[1]); studies <- as.integer(c(words[-(1:2)], 1000)[1]); bad <- FALSE
script <- normalizePath(words[1]); own <- tempfile(); dir.create(own); source(script); setwd(own); set.seed(78)
say <- function(what, n, of, least, most) {
  slack <- 300 * sqrt(0.05 * 0.95 / of); isGood <- 100 * n / of >= least - slack && 100 * n / of <= most + slack; bad <<- bad || !isGood
  cat(sprintf("%-84s %5.1f %% of %d%s\n", what, 100 * n / of, of, if (isGood) "" else "  BEYOND"))
}
# People differ in how they answer, and in what each condition does to them.
people <- function(n, conditions, sizes = n, trials = 3) {
  d <- expand.grid(trial = seq_len(trials), condition = conditions, participant = sprintf("%02d", seq_len(n)), stringsAsFactors = FALSE)
  d$group <- rep(letters[seq_along(sizes)], sizes)[as.integer(d$participant)]
  own <- matrix(rnorm(n * length(conditions), sd = 0.7), n) + rnorm(n)
  transform(d, y = own[cbind(as.integer(d$participant), match(d$condition, conditions))] + rnorm(nrow(d)))
}
six <- c("a-x", "b-x", "a-y", "b-y", "a-z", "b-z"); three <- c("a", "b", "c"); found <- asked <- 0
designs <- list(
  "scores, 2 x 3 within" = function() list(people(13, six), "y", "scores"),
  "scores, 3 within, groups of 12 and 7" = function() list(people(19, three, c(12, 7)), "y", "scores"),
  "scores, groups of 9, 14, 11" = function() list(people(34, "a", c(9, 14, 11)), "y", "scores"),
  "scores, 2 x 3 within, three lack a cell" = function() list(subset(people(13, six), !(participant %in% c("01", "02", "03") & condition == "b-z")), "y", "scores"),
  "points from 1 to 7, 3 within" = function() list(transform(people(14, three, trials = 1), y = pmin(7, pmax(1, round(4 + y)))), "y", "ranks"),
  "shares of two alternatives, 3 within" = function() list(transform(people(15, three, trials = 12), choice = ifelse(runif(540) < plogis(y / 2), "A", "B")), "choice=A", "ranks"))
for (design in names(designs)) {
  p <- do.call(rbind, lapply(seq_len(runs), function(run) {
    results <<- data.frame(); made <- designs[[design]](); capture.output(compare("y", made[[1]], made[[2]], made[[3]]))
    of <- results[results$statistic %in% c("F", "chi-squared", "V", "W", "t") & !is.na(results$p), ]
    tapply(ifelse(is.na(of$p_corrected), of$p, of$p_corrected), ifelse(grepl("^pairs", of$test), paste("any pair of", sub(":.*", "", of$effect)), of$effect), min)
  }))
  for (k in colnames(p)) say(paste0(design, ", ", k), sum(p[, k] < 0.05), runs, 0, if (grepl("mixed", k)) 9 else 5)
  found <- found + sum(p < 0.05); asked <- asked + length(p)
}
cat(sprintf("false findings: %.1f %% of %d questions in %d studies\n", 100 * found / asked, asked, runs * length(designs)))
for (sizes in list(12, c(8, 5))) say(paste("interval of a difference,", paste(sizes, collapse = " and "), "people"), sum(replicate(studies, {
  results <<- data.frame(); d <- people(sum(sizes), c("a", "b"), sizes); capture.output(pairs.test("t", d, "y", "condition", between = if (length(sizes) > 1) "group"))
  results$least <= 0 && 0 <= results$most })), studies, 95, 95)
quit(status = if (bad) 1 else 0)
