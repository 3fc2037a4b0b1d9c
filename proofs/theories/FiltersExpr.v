(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-EXPR] Expressions in doubles: where an operation of src/stream/expr_filter.c gives finite ends, the value lies
    between them; subnormals and overflow included. Not here: that the next pattern is the next double. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval FiltersIntervalSign
  FiltersIntervalCircle FiltersIntervalRoot FiltersScale FiltersStar.
Open Scope R_scope.

(** A number between finite ends. *)
Definition holds (a : iv) (x : R) : Prop := finite (lo a) /\ finite (hi a) /\ val (lo a) <= x <= val (hi a).
Definition good (a : iv) : Prop := finite (lo a) /\ finite (hi a).

Lemma holds_contains a x : holds a x -> contains a x.
Proof.
  intros (F & G & L & U). split; (split; [intros E|now intros _]).
  - rewrite E in F. discriminate.
  - rewrite E in G. discriminate.
Qed.

(** ** One double down, one double up *)

Lemma pred_nan f : is_nan 53 1024 f = true -> is_finite 53 1024 (b64_pred f) = false.
Proof. destruct f; try discriminate; reflexivity. Qed.
Lemma succ_nan f : is_nan 53 1024 f = true -> is_finite 53 1024 (b64_succ f) = false.
Proof. destruct f; try discriminate; reflexivity. Qed.

Lemma lower_step f r : (finite f /\ val f <= rnd r) \/ (f = inf /\ bpow radix2 1024 <= rnd r) ->
  finite (b64_pred f) -> val (b64_pred f) <= r.
Proof.
  intros H F. set (p := val (b64_pred f)). destruct (Rle_or_lt p r) as [L|L]; [exact L|exfalso].
  assert (R : rnd r <= p) by (unfold p; rewrite <- (rnd_id (val (b64_pred f))) by apply val_format; apply rnd_le; unfold p in
    L; lra).
  destruct H as [[Ff V]|[_ A]].
  - destruct (next_down f Ff) as [E|[_ B]]; [rewrite E in F; discriminate|]. fold p in B. pose proof eta_pos. lra.
  - pose proof (val_lt_max (b64_pred f)) as M. pose proof (Rle_abs p). fold p in M. lra.
Qed.
Lemma upper_step f r : (finite f /\ rnd r <= val f) \/ (f = ninf /\ rnd r <= - bpow radix2 1024) ->
  finite (b64_succ f) -> r <= val (b64_succ f).
Proof.
  intros H F. set (p := val (b64_succ f)). destruct (Rle_or_lt r p) as [L|L]; [exact L|exfalso].
  assert (R : p <= rnd r) by (unfold p; rewrite <- (rnd_id (val (b64_succ f))) by apply val_format; apply rnd_le; unfold p in
    L; lra).
  destruct H as [[Ff V]|[_ A]].
  - destruct (next_up f Ff) as [E|[_ B]]; [rewrite E in F; discriminate|]. fold p in B. pose proof eta_pos. lra.
  - pose proof (val_lt_max (b64_succ f)) as M. pose proof (Rle_abs (- p)). rewrite Rabs_Ropp in H. fold p in M. lra.
Qed.

(* C src/stream/expr_filter.c glance_add
  return (dyd_double_span){next_below(a.lo + b.lo), next_above(a.hi + b.hi)};
*)
Definition span_add (a b : iv) : iv := {| lo := b64_pred (lo a + lo b); hi := b64_succ (hi a + hi b) |}.
Theorem span_add_holds a b x y : holds a x -> holds b y -> good (span_add a b) -> holds (span_add a b) (x + y).
Proof.
  intros (A0 & A1 & A2) (B0 & B1 & B2) [F G]. split; [exact F|]. split; [exact G|]. cbn [lo hi span_add] in *. split.
  - apply lower_step; [|exact F]. destruct (fadd_total _ _ A0 B0) as [[K E]|[[E A]|[E _]]].
    + left. split; [exact K|]. rewrite E. apply rnd_le. lra.
    + right. split; [exact E|]. apply Rle_trans with (1 := A). apply rnd_le. lra.
    + rewrite E in F. discriminate.
  - apply upper_step; [|exact G]. destruct (fadd_total _ _ A1 B1) as [[K E]|[[E _]|[E A]]].
    + left. split; [exact K|]. rewrite E. apply rnd_le. lra.
    + rewrite E in G. discriminate.
    + right. split; [exact E|]. apply Rle_trans with (2 := A). apply rnd_le. lra.
Qed.

(* C src/stream/expr_filter.c glance_negated
  return (dyd_double_span){-a.hi, -a.lo};
*)
Definition span_neg (a : iv) : iv := {| lo := - hi a; hi := - lo a |}.
Theorem span_neg_holds a x : holds a x -> holds (span_neg a) (- x).
Proof.
  intros (F & G & L & U). unfold holds, span_neg. cbn [lo hi]. rewrite !fopp_finite, !fopp_val. repeat split; try assumption;
    lra.
Qed.

(** ** Corners *)

(** fmin and fmax of C: of a number and NaN the number. Either zero may be the smaller one: the doubles next to it are the
    same. *)
Definition cmin (a b : double) : double := if lt a b || is_nan 53 1024 b then a else b.
Definition cmax (a b : double) : double := if gt a b || is_nan 53 1024 b then a else b.
Lemma cmin_number a b : is_nan 53 1024 b = false -> cmin a b = if lt a b then a else b.
Proof. unfold cmin. intros ->. now rewrite orb_false_r. Qed.
Lemma cmax_number a b : is_nan 53 1024 b = false -> cmax a b = if gt a b then a else b.
Proof. unfold cmax. intros ->. now rewrite orb_false_r. Qed.
Lemma finite_number x : finite x -> is_nan 53 1024 x = false.
Proof. now destruct x. Qed.
Lemma cmin_least a b : finite a -> finite b -> finite (cmin a b) /\ val (cmin a b) <= val a /\ val (cmin a b) <= val b.
Proof. intros A B. rewrite cmin_number by now apply finite_number. now apply lt_min. Qed.
Lemma cmax_most a b : finite a -> finite b -> finite (cmax a b) /\ val a <= val (cmax a b) /\ val b <= val (cmax a b).
Proof. intros A B. rewrite cmax_number by now apply finite_number. now apply gt_max. Qed.
(* C src/stream/expr_filter.c glance_corners
  if (isnan(p + q + r + s)) return (dyd_double_span){NAN, NAN};
  return (dyd_double_span){next_below(fmin(fmin(p, q), fmin(r, s))), next_above(fmax(fmax(p, q), fmax(r, s)))};
*)
Definition corners (p q r s : double) : iv :=
  if is_nan 53 1024 (p + q + r + s)%D then unknown
  else {| lo := b64_pred (cmin (cmin p q) (cmin r s)); hi := b64_succ (cmax (cmax p q) (cmax r s)) |}.

Section Numbers.
Local Transparent fadd.
Lemma sum_number x y : is_nan 53 1024 (x + y)%D = false -> is_nan 53 1024 x = false /\ is_nan 53 1024 y = false.
Proof. destruct x as [|[|]| |]; destruct y as [|[|]| |]; intros H; try discriminate H; split; reflexivity. Qed.
Local Transparent fmul.
Lemma nan_mul x y : is_nan 53 1024 x = true -> is_nan 53 1024 (x * y)%D = true.
Proof. destruct x; try discriminate; destruct y; reflexivity. Qed.
End Numbers.

Lemma cmin_above a b : is_nan 53 1024 a = false -> is_nan 53 1024 b = false -> cmin a b <> ninf ->
  a <> ninf /\ b <> ninf /\ is_nan 53 1024 (cmin a b) = false.
Proof.
  intros Na Nb H. rewrite (cmin_number a b Nb) in *. destruct (cases a) as [A|[A|[A|A]]]; [|congruence| |]; destruct (cases b) as [B|[B|[B|B]]];
    try congruence.
  - split; [intros ->; discriminate|]. split; [intros ->; discriminate|]. now destruct (lt a b).
  - rewrite B. split; [intros ->; discriminate|]. split; [discriminate|]. now destruct (lt a inf).
  - exfalso. apply H. rewrite B. replace (lt a ninf) with false by (destruct a; try discriminate; reflexivity). reflexivity.
  - rewrite A. split; [discriminate|]. split; [intros ->; discriminate|]. now destruct (lt inf b).
  - rewrite A, B. split; [discriminate|]. split; [discriminate|]. reflexivity.
  - exfalso. apply H. now rewrite A, B.
  - exfalso. apply H. rewrite A. replace (lt ninf b) with true by (destruct b; try discriminate; reflexivity). reflexivity.
  - exfalso. apply H. now rewrite A, B.
  - exfalso. apply H. now rewrite A, B.
Qed.
Lemma cmax_below a b : is_nan 53 1024 a = false -> is_nan 53 1024 b = false -> cmax a b <> inf ->
  a <> inf /\ b <> inf /\ is_nan 53 1024 (cmax a b) = false.
Proof.
  intros Na Nb H. rewrite (cmax_number a b Nb) in *. destruct (cases a) as [A|[A|[A|A]]]; [|congruence| |]; destruct (cases b) as [B|[B|[B|B]]];
    try congruence.
  - split; [intros ->; discriminate|]. split; [intros ->; discriminate|]. now destruct (gt a b).
  - exfalso. apply H. rewrite B. replace (gt a inf) with false by (destruct a; try discriminate; reflexivity). reflexivity.
  - rewrite B. split; [intros ->; discriminate|]. split; [discriminate|]. now destruct (gt a ninf).
  - exfalso. apply H. rewrite A. rewrite (gt_of_inf _ B). reflexivity.
  - exfalso. apply H. now rewrite A, B.
  - exfalso. apply H. now rewrite A, B.
  - rewrite A. split; [discriminate|]. split; [intros ->; discriminate|]. now destruct (gt ninf b).
  - exfalso. apply H. now rewrite A, B.
  - rewrite A, B. split; [discriminate|]. split; [discriminate|]. reflexivity.
Qed.

Lemma finite_of f : is_nan 53 1024 f = false -> f <> inf -> f <> ninf -> finite f.
Proof. intros N I J. destruct (cases f) as [F|[F|[F|F]]]; [exact F|congruence|contradiction|contradiction]. Qed.

(** Finite ends come from finite corners. *)
Lemma corners_finite p q r s : good (corners p q r s) -> finite p /\ finite q /\ finite r /\ finite s.
Proof.
  intros [F G]. unfold corners in *.
  destruct (is_nan 53 1024 (p + q + r + s)%D) eqn:N.
  { exfalso. cbn [lo unknown] in F. pose proof nan_is_nan. destruct nan; discriminate. }
  cbn [lo hi] in *.
  destruct (sum_number _ _ N) as [N1 Ns]. destruct (sum_number _ _ N1) as [N2 Nr]. destruct (sum_number _ _ N2) as [Np Nq].
  set (m := cmin (cmin p q) (cmin r s)) in *. set (M := cmax (cmax p q) (cmax r s)) in *.
  assert (Mm : m <> ninf) by (intros E; rewrite E in F; discriminate).
  assert (MM : M <> inf) by (intros E; rewrite E in G; discriminate).
  assert (nan_min : forall a b, is_nan 53 1024 a = false -> is_nan 53 1024 b = false -> is_nan 53 1024 (cmin a b) = false).
  { intros a b A B. rewrite (cmin_number a b B). now destruct (lt a b). }
  assert (nan_max : forall a b, is_nan 53 1024 a = false -> is_nan 53 1024 b = false -> is_nan 53 1024 (cmax a b) = false).
  { intros a b A B. rewrite (cmax_number a b B). now destruct (gt a b). }
  destruct (cmin_above _ _ (nan_min _ _ Np Nq) (nan_min _ _ Nr Ns) Mm) as (M1 & M2 & _).
  destruct (cmin_above _ _ Np Nq M1) as (P1 & Q1 & _). destruct (cmin_above _ _ Nr Ns M2) as (R1 & S1 & _).
  destruct (cmax_below _ _ (nan_max _ _ Np Nq) (nan_max _ _ Nr Ns) MM) as (M3 & M4 & _).
  destruct (cmax_below _ _ Np Nq M3) as (P2 & Q2 & _). destruct (cmax_below _ _ Nr Ns M4) as (R2 & S2 & _).
  pose proof (finite_of p Np P2 P1) as Fp. pose proof (finite_of q Nq Q2 Q1) as Fq.
  pose proof (finite_of r Nr R2 R1) as Fr. pose proof (finite_of s Ns S2 S1) as Fs.
  now repeat split.
Qed.

Theorem corners_hold p q r s x :
  (finite p -> finite q -> finite r -> finite s ->
    (val p <= rnd x \/ val q <= rnd x \/ val r <= rnd x \/ val s <= rnd x) /\
    (rnd x <= val p \/ rnd x <= val q \/ rnd x <= val r \/ rnd x <= val s)) ->
  good (corners p q r s) -> holds (corners p q r s) x.
Proof.
  intros H FG. destruct (corners_finite _ _ _ _ FG) as (Fp & Fq & Fr & Fs). destruct FG as [F G].
  split; [exact F|]. split; [exact G|]. unfold corners in *.
  destruct (is_nan 53 1024 (p + q + r + s)%D).
  { exfalso. cbn [lo unknown] in F. pose proof nan_is_nan. destruct nan; discriminate. }
  cbn [lo hi] in *.
  destruct (H Fp Fq Fr Fs) as [L U].
  assert (least : forall a b, finite a -> finite b -> finite (cmin a b) /\ val (cmin a b) <= val a /\ val (cmin a b) <= val b)
    by exact cmin_least.
  assert (most : forall a b, finite a -> finite b -> finite (cmax a b) /\ val a <= val (cmax a b) /\ val b <= val (cmax a b))
    by exact cmax_most.
  destruct (least p q Fp Fq) as (G1 & A1 & A2). destruct (least r s Fr Fs) as (G2 & A3 & A4).
  destruct (most p q Fp Fq) as (G3 & B1 & B2). destruct (most r s Fr Fs) as (G4 & B3 & B4).
  destruct (least _ _ G1 G2) as (G5 & A5 & A6). destruct (most _ _ G3 G4) as (G6 & B5 & B6).
  split.
  - apply lower_step; [|exact F]. left. split; [exact G5|]. destruct L as [L|[L|[L|L]]]; lra.
  - apply upper_step; [|exact G]. left. split; [exact G6|]. destruct U as [U|[U|[U|U]]]; lra.
Qed.

(* C src/stream/expr_filter.c glance_multiply
  if (a.lo >= 0 && b.lo >= 0) return (dyd_double_span){next_below(a.lo * b.lo), next_above(a.hi * b.hi)};
  return glance_corners(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
*)
Definition span_mul (a b : iv) : iv :=
  if le (lit c_zero) (lo a) && le (lit c_zero) (lo b) then {| lo := b64_pred (lo a * lo b); hi := b64_succ (hi a * hi b) |}
  else corners (lo a * lo b) (lo a * hi b) (hi a * lo b) (hi a * hi b).
Theorem span_mul_holds a b x y : holds a x -> holds b y -> good (span_mul a b) -> holds (span_mul a b) (x * y).
Proof.
  intros (A0 & A1 & A2 & A3) (B0 & B1 & B2 & B3). unfold span_mul. destruct zero_lit as [Fz Vz].
  destruct (le (lit c_zero) (lo a) && le (lit c_zero) (lo b)) eqn:C.
  - apply andb_prop in C. destruct C as [Ca Cb]. apply le_finite in Ca; [|assumption..]. apply le_finite in Cb;
      [|assumption..]. rewrite Vz in *. intros [F G]. split; [exact F|]. split; [exact G|]. cbn [lo hi] in *.
    assert (N : nneg (hi a * hi b)%D) by (apply nneg_mul; apply nneg_of_val; try assumption; lra).
    destruct (cases (hi a * hi b)%D) as [K|[K|[K|K]]]; [|rewrite (succ_nan _ K) in G; discriminate|rewrite K in G;
      discriminate|rewrite K in N; discriminate].
    destruct (fmul_inv _ _ K) as (_ & _ & E).
    assert (P : 0 <= val (lo a) * val (lo b)) by (apply Rmult_le_pos; lra).
    assert (Q : val (lo a) * val (lo b) <= val (hi a) * val (hi b)) by (apply Rmult_le_compat; lra).
    destruct (fmul_finite (lo a) (lo b) A0 B0) as [J V].
    { rewrite Rabs_pos_eq by now apply rnd_pos. apply Rle_lt_trans with (val (hi a * hi b)%D); [rewrite E; now apply rnd_le|].
      apply Rle_lt_trans with (1 := Rle_abs _), val_lt_max. }
    split.
    + apply lower_step; [|exact F]. left. split; [exact J|]. rewrite V. apply rnd_le, Rmult_le_compat; lra.
    + apply upper_step; [|exact G]. left. split; [exact K|]. rewrite E. apply rnd_le, Rmult_le_compat; lra.
  - apply corners_hold. intros P Q R S.
    destruct (fmul_inv _ _ P) as (_ & _ & ->). destruct (fmul_inv _ _ Q) as (_ & _ & ->).
    destruct (fmul_inv _ _ R) as (_ & _ & ->). destruct (fmul_inv _ _ S) as (_ & _ & ->). split.
    + destruct (corner_low _ _ _ _ _ _ (conj A2 A3) (conj B2 B3)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
    + destruct (corner_high _ _ _ _ _ _ (conj A2 A3) (conj B2 B3)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
Qed.

(* C src/stream/expr_filter.c glance_divide
  if (b.lo <= 0 && b.hi >= 0) return (dyd_double_span){NAN, NAN};
  return glance_corners(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi);
*)
Definition span_div (a b : iv) : iv :=
  if le (lo b) (lit c_zero) && le (lit c_zero) (hi b) then unknown
  else corners (lo a / lo b) (lo a / hi b) (hi a / lo b) (hi a / hi b).
(** Defined, and between the ends. *)
Theorem span_div_holds a b x y : holds a x -> holds b y -> good (span_div a b) -> y <> 0 /\ holds (span_div a b) (x / y).
Proof.
  intros (A0 & A1 & A2 & A3) HB. pose proof (holds_contains _ _ HB) as CB. destruct HB as (B0 & B1 & B2 & B3).
  destruct zero_lit as [Fz Vz]. unfold span_div. destruct (le (lo b) (lit c_zero) && le (lit c_zero) (hi b)) eqn:C.
  { intros [F _]. exfalso. cbn [lo unknown] in F. pose proof nan_is_nan. destruct nan; discriminate. }
  assert (S : gt (lo b) (lit c_zero) = true \/ lt (hi b) (lit c_zero) = true).
  { apply andb_false_iff in C. destruct C as [C|C]; apply le_false in C; try assumption.
    - left. now apply gt_finite.
    - right. now apply lt_finite. }
  assert (NZ : y <> 0).
  { destruct S as [S|S]; [apply gt_finite in S|apply lt_finite in S]; try assumption; rewrite Vz in S; lra. }
  assert (num : forall f, finite f -> is_nan 53 1024 f = false) by (intros f F; destruct f; try discriminate; reflexivity).
  destruct (recips b y CB S (num _ B0) (num _ B1)) as (Z1 & Z2 & Y1 & Y2).
  intros G. split; [exact NZ|]. revert G. apply corners_hold. intros P Q R T.
  destruct (fdiv_inv _ _ Z1 P) as (_ & _ & ->). destruct (fdiv_inv _ _ Z2 Q) as (_ & _ & ->).
  destruct (fdiv_inv _ _ Z1 R) as (_ & _ & ->). destruct (fdiv_inv _ _ Z2 T) as (_ & _ & ->). unfold Rdiv. split.
  - destruct (corner_low _ _ _ _ _ _ (conj A2 A3) (conj Y1 Y2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
  - destruct (corner_high _ _ _ _ _ _ (conj A2 A3) (conj Y1 Y2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
Qed.

(* C src/stream/expr_filter.c glance_square_root
  if (a.lo < 0 && range.lo < 0) return (dyd_double_span){NAN, NAN};
  double lo = a.lo > 0 ? next_below(sqrt(a.lo)) : 0;
  return (dyd_double_span){lo, next_above(sqrt(a.hi))};
*)
Definition span_sqrt (a : iv) (known : bool) : iv :=
  if lt (lo a) (lit c_zero) && negb known then unknown
  else {| lo := if gt (lo a) (lit c_zero) then b64_pred (fsqrt (lo a)) else lit c_zero; hi := b64_succ (fsqrt (hi a)) |}.
(** known: by its form the value is not negative. *)
Theorem span_sqrt_holds a x known : holds a x -> (known = true -> 0 <= x) -> good (span_sqrt a known) ->
  0 <= x /\ holds (span_sqrt a known) (sqrt x).
Proof.
  intros (A0 & A1 & A2 & A3) K. unfold span_sqrt. destruct zero_lit as [Fz Vz].
  destruct (lt (lo a) (lit c_zero) && negb known) eqn:C.
  { intros [F _]. exfalso. cbn [lo unknown] in F. pose proof nan_is_nan. destruct nan; discriminate. }
  assert (X : 0 <= x).
  { apply andb_false_iff in C. destruct C as [C|C]; [|apply K; now destruct known].
    destruct (Rle_or_lt 0 (val (lo a))) as [P|N]; [lra|]. rewrite <- Vz in N. apply (lt_finite _ _ A0 Fz) in N. congruence. }
  intros [F G]. split; [exact X|]. split; [exact F|]. split; [exact G|]. cbn [lo hi] in *. split.
  - destruct (gt (lo a) (lit c_zero)) eqn:P; [|rewrite Vz; apply sqrt_pos]. apply gt_finite in P; [|assumption..].
    pose proof (fsqrt_finite (lo a) A0 ltac:(lra)) as S. apply lower_step; [|exact F]. left. split; [exact S|].
    destruct (fsqrt_inv _ S) as (_ & _ & ->). now apply rnd_le, sqrt_le_1_alt.
  - pose proof (fsqrt_finite (hi a) A1 ltac:(lra)) as S. apply upper_step; [|exact G]. left. split; [exact S|].
    destruct (fsqrt_inv _ S) as (_ & _ & ->). now apply rnd_le, sqrt_le_1_alt.
Qed.

(* C src/stream/expr_filter.c glance_absolute
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return glance_negated(a);
  return (dyd_double_span){0, fmax(-a.lo, a.hi)};
*)
Definition span_abs (a : iv) : iv :=
  if le (lit c_zero) (lo a) then a
  else if le (hi a) (lit c_zero) then span_neg a
  else {| lo := lit c_zero; hi := cmax (- lo a) (hi a) |}.
Theorem span_abs_holds a x : holds a x -> holds (span_abs a) (Rabs x).
Proof.
  intros H. pose proof H as (A0 & A1 & A2 & A3). destruct zero_lit as [Fz Vz]. unfold span_abs.
  destruct (le (lit c_zero) (lo a)) eqn:C.
  { apply le_finite in C; [|assumption..]. rewrite Rabs_pos_eq by lra. exact H. }
  destruct (le (hi a) (lit c_zero)) eqn:D.
  { apply le_finite in D; [|assumption..]. rewrite Rabs_left1 by lra. now apply span_neg_holds. }
  assert (An : finite (- lo a)%D) by now rewrite fopp_finite.
  assert (M : finite (cmax (- lo a) (hi a)) /\ val (- lo a)%D <= val (cmax (- lo a) (hi a)) /\
    val (hi a) <= val (cmax (- lo a) (hi a))) by exact (cmax_most _ _ An A1).
  destruct M as (F & M1 & M2). rewrite fopp_val in M1.
  split; [exact Fz|]. split; [exact F|]. cbn [lo hi]. split; [rewrite Vz; apply Rabs_pos|]. apply Rabs_le. lra.
Qed.

Lemma cmin_value a b : finite a -> finite b -> finite (cmin a b) /\ val (cmin a b) = Rmin (val a) (val b).
Proof.
  intros Fa Fb. rewrite cmin_number by now apply finite_number. generalize (lt_finite a b Fa Fb). destruct (lt a b); intros [I J].
  - specialize (I eq_refl). split; [exact Fa|]. rewrite Rmin_left; lra.
  - split; [exact Fb|]. rewrite Rmin_right; [reflexivity|].
    destruct (Rle_or_lt (val b) (val a)) as [L|L]; [exact L|discriminate (J L)].
Qed.
Lemma cmax_value a b : finite a -> finite b -> finite (cmax a b) /\ val (cmax a b) = Rmax (val a) (val b).
Proof.
  intros Fa Fb. rewrite cmax_number by now apply finite_number. generalize (gt_finite a b Fa Fb). destruct (gt a b); intros [I J].
  - specialize (I eq_refl). split; [exact Fa|]. rewrite Rmax_left; lra.
  - split; [exact Fb|]. rewrite Rmax_right; [reflexivity|].
    destruct (Rle_or_lt (val a) (val b)) as [L|L]; [exact L|discriminate (J L)].
Qed.
(** Minimum and maximum, as `binary` takes them. *)
Theorem span_min_holds a b x y : holds a x -> holds b y ->
  holds {| lo := cmin (lo a) (lo b); hi := cmin (hi a) (hi b) |} (Rmin x y) /\
  holds {| lo := cmax (lo a) (lo b); hi := cmax (hi a) (hi b) |} (Rmax x y).
Proof.
  intros (A0 & A1 & A2 & A3) (B0 & B1 & B2 & B3). unfold holds. cbn [lo hi].
  destruct (cmin_value _ _ A0 B0) as [F1 ->]. destruct (cmin_value _ _ A1 B1) as [F2 ->].
  destruct (cmax_value _ _ A0 B0) as [F3 ->]. destruct (cmax_value _ _ A1 B1) as [F4 ->].
  unfold Rmin, Rmax. repeat (split; try assumption);
    repeat match goal with |- context [Rle_dec ?a ?b] => destruct (Rle_dec a b) as [?|?%Rnot_le_lt] end; lra.
Qed.

(** A constant: integers up to 2^53 in size are doubles; their quotient is rounded once. *)
Theorem span_quotient_holds n d : finite n -> finite d -> val d <> 0 -> finite (n / d)%D ->
  good {| lo := b64_pred (n / d); hi := b64_succ (n / d) |} ->
  holds {| lo := b64_pred (n / d); hi := b64_succ (n / d) |} (val n / val d).
Proof.
  intros Fn Fd Nd F [P S]. destruct (fdiv_inv n d (fun _ => Nd) F) as (_ & _ & E). unfold recip in E. rewrite Fd in E.
  split; [exact P|]. split; [exact S|]. cbn [lo hi] in *. split.
  - apply lower_step; [|exact P]. left. split; [exact F|]. rewrite E. apply Rle_refl.
  - apply upper_step; [|exact S]. left. split; [exact F|]. rewrite E. apply Rle_refl.
Qed.
