(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [ORI-1] Products of intervals, and the orientation of boxes in interval arithmetic. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersOrient FiltersInterval.
Open Scope R_scope.

Definition nan : double := fsub inf inf.
Section Nan.
Local Transparent fsub.
Lemma nan_is_nan : is_nan 53 1024 nan = true.
Proof. reflexivity. Qed.
End Nan.
Definition unknown : iv := {| lo := nan; hi := nan |}.

Lemma unknown_contains x : contains unknown x.
Proof.
  pose proof nan_is_nan as N. split; (split; simpl; [intros E; rewrite E in N; discriminate|]);
    intros F; destruct nan; discriminate.
Qed.

(* C src/predicate/interval_filter.h dyd_iv_span4
  if (!isfinite(p + q + r + s)) return DYD_IV_UNKNOWN;
  double lo1 = p < q ? p : q, hi1 = p < q ? q : p, lo2 = r < s ? r : s, hi2 = r < s ? s : r;
  return (dyd_iv){dyd_down(lo1 < lo2 ? lo1 : lo2), dyd_up(hi1 > hi2 ? hi1 : hi2)};
*)
Definition span4 (p q r s : double) : iv :=
  if negb (is_finite 53 1024 (p + q + r + s)%D) then unknown
  else
    let lo1 := if lt p q then p else q in let hi1 := if lt p q then q else p in
    let lo2 := if lt r s then r else s in let hi2 := if lt r s then s else r in
    {| lo := down (if lt lo1 lo2 then lo1 else lo2); hi := up (if gt hi1 hi2 then hi1 else hi2) |}.
(* C src/predicate/interval_filter.h dyd_iv_mul
  return dyd_iv_span4(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
*)
Definition iv_mul (a b : iv) : iv := span4 (lo a * lo b) (lo a * hi b) (hi a * lo b) (hi a * hi b).
(* C src/predicate/interval_filter.h dyd_iv_sign
  return a.lo > 0 ? 1 : a.hi < 0 ? -1 : 0;
*)
Definition iv_sign (a : iv) : Z := if gt (lo a) (lit c_zero) then 1%Z else if lt (hi a) (lit c_zero) then (-1)%Z else
  0%Z.

(** The smaller and the larger of two. *)
Lemma lt_min p q : finite p -> finite q -> let m := if lt p q then p else q in
  finite m /\ val m <= val p /\ val m <= val q.
Proof.
  intros P Q. generalize (lt_finite p q P Q). destruct (lt p q); intros [I J]; cbv zeta.
  - specialize (I eq_refl). repeat split; [exact P|lra|lra].
  - assert (val q <= val p) by (destruct (Rle_or_lt (val q) (val p)) as [L|L]; [exact L|discriminate (J L)]).
    repeat split; [exact Q|lra|lra].
Qed.
Lemma lt_max p q : finite p -> finite q -> let m := if lt p q then q else p in
  finite m /\ val p <= val m /\ val q <= val m.
Proof.
  intros P Q. generalize (lt_finite p q P Q). destruct (lt p q); intros [I J]; cbv zeta.
  - specialize (I eq_refl). repeat split; [exact Q|lra|lra].
  - assert (val q <= val p) by (destruct (Rle_or_lt (val q) (val p)) as [L|L]; [exact L|discriminate (J L)]).
    repeat split; [exact P|lra|lra].
Qed.
Lemma gt_max p q : finite p -> finite q -> let m := if gt p q then p else q in
  finite m /\ val p <= val m /\ val q <= val m.
Proof.
  intros P Q. generalize (gt_finite p q P Q). destruct (gt p q); intros [I J]; cbv zeta.
  - specialize (I eq_refl). repeat split; [exact P|lra|lra].
  - assert (val p <= val q) by (destruct (Rle_or_lt (val p) (val q)) as [L|L]; [exact L|discriminate (J L)]).
    repeat split; [exact Q|lra|lra].
Qed.

Lemma span4_contains p q r s x :
  (finite p -> finite q -> finite r -> finite s ->
    (val p <= rnd x \/ val q <= rnd x \/ val r <= rnd x \/ val s <= rnd x) /\
    (rnd x <= val p \/ rnd x <= val q \/ rnd x <= val r \/ rnd x <= val s)) -> contains (span4 p q r s) x.
Proof.
  intros H. unfold span4. destruct (is_finite 53 1024 (p + q + r + s)%D) eqn:F; [|apply unknown_contains]. cbn [negb].
  destruct (fadd_inv _ _ F) as (F1 & Fs & _). destruct (fadd_inv _ _ F1) as (F2 & Fr & _).
  destruct (fadd_inv _ _ F2) as (Fp & Fq & _). specialize (H Fp Fq Fr Fs). destruct H as [L U]. cbv zeta.
  destruct (lt_min p q Fp Fq) as (G1 & A1 & A2). destruct (lt_min r s Fr Fs) as (G2 & A3 & A4).
  destruct (lt_max p q Fp Fq) as (G3 & B1 & B2). destruct (lt_max r s Fr Fs) as (G4 & B3 & B4).
  destruct (lt_min _ _ G1 G2) as (G5 & A5 & A6). destruct (gt_max _ _ G3 G4) as (G6 & B5 & B6).
  split; (split; [apply down_not_inf || apply up_not_ninf|]); simpl; intros K.
  - apply down_below; [exact K|]. destruct L as [L|[L|[L|L]]].
    + exact (Rle_trans _ _ _ A5 (Rle_trans _ _ _ A1 L)).
    + exact (Rle_trans _ _ _ A5 (Rle_trans _ _ _ A2 L)).
    + exact (Rle_trans _ _ _ A6 (Rle_trans _ _ _ A3 L)).
    + exact (Rle_trans _ _ _ A6 (Rle_trans _ _ _ A4 L)).
  - apply up_above; [exact K|]. destruct U as [U|[U|[U|U]]].
    + exact (Rle_trans _ _ _ (Rle_trans _ _ _ U B1) B5).
    + exact (Rle_trans _ _ _ (Rle_trans _ _ _ U B2) B5).
    + exact (Rle_trans _ _ _ (Rle_trans _ _ _ U B3) B6).
    + exact (Rle_trans _ _ _ (Rle_trans _ _ _ U B4) B6).
Qed.

Lemma corner_low a0 a1 b0 b1 x y : a0 <= x <= a1 -> b0 <= y <= b1 ->
  a0 * b0 <= x * y \/ a0 * b1 <= x * y \/ a1 * b0 <= x * y \/ a1 * b1 <= x * y.
Proof.
  intros X Y. assert (S : forall a, a * b0 <= a * y \/ a * b1 <= a * y).
  { intros a. destruct (Rle_or_lt 0 a); [left; apply Rmult_le_compat_l; lra|right].
    assert (- a * y <= - a * b1) by (apply Rmult_le_compat_l; lra). lra. }
  destruct (Rle_or_lt 0 y).
  - assert (a0 * y <= x * y) by (apply Rmult_le_compat_r; lra). destruct (S a0); [left|right; left]; lra.
  - assert (x * - y <= a1 * - y) by (apply Rmult_le_compat_r; lra).
    destruct (S a1); [right; right; left|right; right; right]; lra.
Qed.
Lemma corner_high a0 a1 b0 b1 x y : a0 <= x <= a1 -> b0 <= y <= b1 ->
  x * y <= a0 * b0 \/ x * y <= a0 * b1 \/ x * y <= a1 * b0 \/ x * y <= a1 * b1.
Proof.
  intros X Y. destruct (corner_low (- a1) (- a0) b0 b1 (- x) y) as [H|[H|[H|H]]]; try lra.
Qed.

Theorem iv_mul_contains a b x y : contains a x -> contains b y -> contains (iv_mul a b) (x * y).
Proof.
  intros [[_ A1] [_ A2]] [[_ B1] [_ B2]]. unfold iv_mul. apply span4_contains. intros P Q R S.
  destruct (fmul_inv _ _ P) as (F1 & F2 & EP). destruct (fmul_inv _ _ Q) as (_ & F3 & EQ).
  destruct (fmul_inv _ _ R) as (F4 & _ & ER). destruct (fmul_inv _ _ S) as (_ & _ & ES).
  rewrite EP, EQ, ER, ES. specialize (A1 F1). specialize (A2 F4). specialize (B1 F2). specialize (B2 F3). split.
  - destruct (corner_low _ _ _ _ _ _ (conj A1 A2) (conj B1 B2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
  - destruct (corner_high _ _ _ _ _ _ (conj A1 A2) (conj B1 B2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
Qed.

Lemma iv_sign_correct a x : contains a x -> (iv_sign a = 1%Z -> 0 < x) /\ (iv_sign a = (-1)%Z -> x < 0).
Proof.
  intros [[N1 A1] [N2 A2]]. destruct zero_lit as [Fz Vz]. unfold iv_sign.
  assert (P : gt (lo a) (lit c_zero) = true -> 0 < x).
  { intros G. destruct (cases (lo a)) as [F|[F|[F|F]]].
    - apply gt_finite in G; [|exact F|exact Fz]. specialize (A1 F). lra.
    - exfalso. destruct (lo a); try discriminate; destruct (lit c_zero); discriminate.
    - contradiction.
    - exfalso. rewrite F, (gt_ninf _ Fz) in G. discriminate. }
  assert (Q : lt (hi a) (lit c_zero) = true -> x < 0).
  { intros G. destruct (cases (hi a)) as [F|[F|[F|F]]].
    - apply lt_finite in G; [|exact F|exact Fz]. specialize (A2 F). lra.
    - exfalso. destruct (hi a); try discriminate; destruct (lit c_zero); discriminate.
    - exfalso. rewrite F in G. destruct (lit c_zero); discriminate.
    - contradiction. }
  destruct (gt (lo a) (lit c_zero)); [split; [intros _; now apply P|discriminate]|].
  destruct (lt (hi a) (lit c_zero)); [split; [discriminate|intros _; now apply Q]|]. split; discriminate.
Qed.

(* C src/predicate/predicate_filter.c iv_det2
  return dyd_iv_sub(dyd_iv_mul(p, q), dyd_iv_mul(r, s));
*)
Definition iv_det2 (p q r s : iv) : iv := iv_sub (iv_mul p q) (iv_mul r s).
(* C src/predicate/predicate_filter.c sign_of_boxes
  dyd_iv ux = dyd_iv_sub(side_x(b), side_x(a)), uy = dyd_iv_sub(side_y(b), side_y(a));
  dyd_iv vx = dyd_iv_sub(side_x(c), side_x(a)), vy = dyd_iv_sub(side_y(c), side_y(a));
  return dyd_iv_sign(iv_det2(ux, vy, uy, vx));
*)
Definition sign_of_boxes (ax ay bx by_ cx cy : iv) : Z :=
  let ux := iv_sub bx ax in let uy := iv_sub by_ ay in
  let vx := iv_sub cx ax in let vy := iv_sub cy ay in
  iv_sign (iv_det2 ux vy uy vx).

(** A sign for boxes is the sign of det(q - p, r - p) for every choice p, q, r in them. *)
Theorem sign_of_boxes_correct ax ay bx by_ cx cy px py qx qy rx ry :
  contains ax px -> contains ay py -> contains bx qx -> contains by_ qy -> contains cx rx -> contains cy ry ->
  let det := (qx - px) * (ry - py) - (qy - py) * (rx - px) in
  (sign_of_boxes ax ay bx by_ cx cy = 1%Z -> 0 < det) /\ (sign_of_boxes ax ay bx by_ cx cy = (-1)%Z -> det < 0).
Proof.
  intros A B C D E F det. apply iv_sign_correct. unfold det, iv_det2.
  apply iv_sub_contains; apply iv_mul_contains; now apply iv_sub_contains.
Qed.
