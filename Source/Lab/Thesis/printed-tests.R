# SPDX-License-Identifier: MIT
# The forty tests that the thesis prints: p of each printed statistic by its printed degrees of freedom, beside the printed p; both may have been
# rounded. The degrees of freedom of Table 4.1 are those of an analysis of single trials with a block per participant (16 x 175 - 35 - 15 = 2750),
# not of repeated measures. Rscript printed-tests.R [TESTS.csv]; fails if others than the four known ones differ.
# F(df1, df2), chi-squared(df1) (X), or Wilcoxon's W of df1 differences at most.
printed <- read.table(sep = ";", quote = "", colClasses = "character", header = TRUE, text = "where;effect;statistic;df1;df2;value;p_printed;note
3.2.2;percent correct: configuration;F;1;11;0.21;0.658;
3.2.2;percent correct: number of enchanters;F;1;11;4.62;0.055;three numbers of enchanters have (2, 22) degrees of freedom in repeated measures
4.1.2;percent correct: configuration;F;1;17;53.94;< 0.001;
4.1.2;percent correct, tolerance 1: configuration;F;1;17;39.51;< 0.001;
4.1.2;percent correct: grid;F;2;34;573.4;< 0.001;
4.1.2;percent correct, tolerance 1: grid;F;2;34;69.35;< 0.001;
Table 4.1;PHONE-LINEAR, perceived row: row;F;4;2750;2310;< 0.001;
Table 4.1;PHONE-LINEAR, perceived row: column;F;6;2750;8.73;< 0.001;
Table 4.1;PHONE-LINEAR, perceived row: row:column;F;24;2750;4.31;< 0.001;
Table 4.1;PHONE-LINEAR, perceived column: row;F;4;2750;11.6;< 0.001;
Table 4.1;PHONE-LINEAR, perceived column: column;F;6;2750;1988;< 0.001;
Table 4.1;PHONE-LINEAR, perceived column: row:column;F;24;2750;1.406;0.091;
Table 4.1;PHONE-LOGARITHM, perceived row: row;F;4;2750;1831;< 0.001;
Table 4.1;PHONE-LOGARITHM, perceived row: column;F;6;2750;3.23;0.004;
Table 4.1;PHONE-LOGARITHM, perceived row: row:column;F;24;2750;4.74;< 0.001;
Table 4.1;PHONE-LOGARITHM, perceived column: row;F;4;2750;24.4;< 0.001;
Table 4.1;PHONE-LOGARITHM, perceived column: column;F;6;2750;1539;< 0.001;
Table 4.1;PHONE-LOGARITHM, perceived column: row:column;F;24;2750;3.57;< 0.001;
Table 4.1;RING-LINEAR, perceived row: row;F;4;2750;2381;< 0.001;
Table 4.1;RING-LINEAR, perceived row: column;F;6;2750;7.50;< 0.001;
Table 4.1;RING-LINEAR, perceived row: row:column;F;24;2750;2.45;< 0.001;
Table 4.1;RING-LINEAR, perceived column: row;F;4;2750;5.39;< 0.001;
Table 4.1;RING-LINEAR, perceived column: column;F;6;2750;2998;< 0.001;
Table 4.1;RING-LINEAR, perceived column: row:column;F;24;2750;2.45;< 0.001;
Table 4.1;RING-LOGARITHM, perceived row: row;F;4;2750;2684;< 0.001;
Table 4.1;RING-LOGARITHM, perceived row: column;F;6;2750;2.77;0.008;
Table 4.1;RING-LOGARITHM, perceived row: row:column;F;24;2750;1.83;< 0.001;
Table 4.1;RING-LOGARITHM, perceived column: row;F;4;2750;21.7;< 0.001;
Table 4.1;RING-LOGARITHM, perceived column: column;F;6;2750;2918;< 0.001;
Table 4.1;RING-LOGARITHM, perceived column: row:column;F;24;2750;5.201;< 0.001;
5.2.2;votes: RM against SV;W;20;0;412.5;0.017;20 participants allow a W of at most 210, 27 conditions 378: the unit is neither
5.2.2;votes: object size;X;2;0;6.68;0.036;
5.2.2;votes: object pair;X;2;0;0.078;0.96;
5.2.2;votes: falling distance;X;2;0;0.10;0.95;
5.3.2;realism: amplitude;F;1;19;13.8;0.0147;
5.3.2;liking: amplitude;F;1;19;10.87;0.0038;
5.3.2;realism: frequency;F;1;19;56.49;< 0.001;
5.3.2;harmony: frequency;F;1;19;32.98;< 0.001;
5.3.2;liking: frequency;F;1;19;59.74;< 0.001;
5.3.2;realism: decay rate;F;1;19;6.30;0.021;")
chance <- function(test, value) {
  df1 <- as.numeric(test$df1)
  if (test$statistic == "F") pf(value, df1, as.numeric(test$df2), lower.tail = FALSE)
  else if (test$statistic == "X") pchisq(value, df1, lower.tail = FALSE)
  else if (value > df1 * (df1 + 1) / 2) NA
  else min(1, 2 * psignrank(min(value, df1 * (df1 + 1) / 2 - value), df1))
}
rounding <- function(words) if (grepl(".", words, fixed = TRUE)) 0.5 * 10^-nchar(sub(".*[.]", "", words)) else 0.5 # half of the last digit
# Whether some statistic that is printed like this one has a p that is printed like that.
is.as.printed <- function(test) {
  value <- as.numeric(test$value)
  most <- chance(test, value - rounding(test$value)); least <- chance(test, value + rounding(test$value))
  if (is.na(most) || is.na(least)) return(FALSE)
  if (startsWith(test$p_printed, "< ")) return(least < as.numeric(substring(test$p_printed, 3)))
  p <- as.numeric(test$p_printed)
  p + rounding(test$p_printed) >= least && p - rounding(test$p_printed) <= most
}
lines <- split(printed, seq_len(nrow(printed)))
printed$p <- sapply(lines, function(test) chance(test, as.numeric(test$value)))
printed$as_printed <- sapply(lines, is.as.printed)
options(width = 200)
print(format(printed[c("where", "effect", "statistic", "df1", "df2", "value", "p_printed", "p", "as_printed")], digits = 3), row.names = FALSE)
if (length(commandArgs(TRUE)) > 0) write.csv(printed, commandArgs(TRUE)[1], row.names = FALSE, na = "impossible")
other <- printed[!printed$as_printed, "effect"]
cat(nrow(printed), "tests,", length(other), "whose printed p is not that of the printed statistic:", paste(other, collapse = "; "), "\n")
known <- c("RING-LOGARITHM, perceived row: column", "RING-LOGARITHM, perceived row: row:column", "votes: RM against SV", "realism: amplitude")
stopifnot(nrow(printed) == 40, identical(other, known), abs(printed$p[printed$effect == "realism: amplitude"] - 0.001470) < 1e-5)
