(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [AREA-T] dyd_filter_partial_edge_area2 in binary64: where it succeeds, its result is not below twice the area of the
    hull, and exceeds it by at most 2^-86 of it. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance.
From Dyadel Require Import Distance AreaHull AreaForms AreaDouble AreaDoubleMul.
Open Scope R_scope.

(** ** The C code *)

(* [AREA-T] src/metric/measure_filter.c: return x.h == 0 || (x.h >= {} && *)
Definition c_lead_least : const := (1, -400)%Z.
(* [AREA-T] src/metric/measure_filter.c: && x.h <= {}); *)
Definition c_lead_most : const := (1, 400)%Z.
(* C src/metric/measure_filter.c dd_lead_in_range
  return x.h == 0 || (x.h >= 0x1p-400 && x.h <= 0x1p400);
*)
Definition equal (x y : double) : bool := match b64_compare x y with Some Eq => true | _ => false end.
Definition lead_in_range (x : dd) : bool :=
  equal (fst x) (lit c_zero) || (le (lit c_lead_least) (fst x) && le (fst x) (lit c_lead_most)).

(* C src/metric/measure_filter.c area2_axis_set
  out->b_low = b[0] < a[0];
  out->b_high = b[1] > a[1];
  out->wa = dd_sub_d(a[1], a[0]);
  out->wb = dd_sub_d(b[1], b[0]);
  out->low = out->b_low ? dd_sub_d(a[0], b[0]) : dd_sub_d(b[0], a[0]);
  out->high = out->b_high ? dd_sub_d(b[1], a[1]) : dd_sub_d(a[1], b[1]);
  return dd_lead_in_range(out->wa) && dd_lead_in_range(out->wb) && dd_lead_in_range(out->low) && dd_lead_in_range(out->high);
*)
Record daxis : Type := DAxis { dwa : dd; dwb : dd; dlow : dd; dhigh : dd; db_low : bool; db_high : bool }.
Definition axis_made (a0 a1 b0 b1 : double) : daxis :=
  DAxis (dd_sub_d a1 a0) (dd_sub_d b1 b0) (if lt b0 a0 then dd_sub_d a0 b0 else dd_sub_d b0 a0)
    (if gt b1 a1 then dd_sub_d b1 a1 else dd_sub_d a1 b1) (lt b0 a0) (gt b1 a1).
Definition axis_fine (x : daxis) : bool :=
  lead_in_range (dwa x) && lead_in_range (dwb x) && lead_in_range (dlow x) && lead_in_range (dhigh x).

(* C src/metric/measure_filter.c area2_one
  dd p = x->b_low ? x->low : x->high;
  dd whole = dd_mul(x->wa, y->wa), part = dd_mul(p, dd_add(y->wa, y->wb));
  return dd_add(dd_add(whole, whole), part);
*)
Definition one (x y : daxis) : dd :=
  let p := if db_low x then dlow x else dhigh x in
  let whole := dd_mul (dwa x) (dwa y) in let part := dd_mul p (dd_add (dwa y) (dwb y)) in
  dd_add (dd_add whole whole) part.
(* C src/metric/measure_filter.c area2_corner
  dd p = x->b_low ? x->low : x->high, r = x->b_low ? x->high : x->low;
  dd tall = dd_add(y->wa, y->b_low ? y->low : y->high);
  dd left = dd_add(dd_mul(x->wa, tall), dd_mul(p, y->wb));
  return dd_add(left, dd_add(dd_mul(x->wb, tall), dd_mul(r, y->wa)));
*)
Definition corner (x y : daxis) : dd :=
  let p := if db_low x then dlow x else dhigh x in let r := if db_low x then dhigh x else dlow x in
  let tall := dd_add (dwa y) (if db_low y then dlow y else dhigh y) in
  dd_add (dd_add (dd_mul (dwa x) tall) (dd_mul p (dwb y))) (dd_add (dd_mul (dwb x) tall) (dd_mul r (dwa y))).
(* C src/metric/measure_filter.c area2_cross
  return dd_add(dd_mul(x->wb, dd_add(y->wa, y->wb)), dd_mul(x->wa, dd_add(y->low, y->high)));
*)
Definition cross (x y : daxis) : dd :=
  dd_add (dd_mul (dwb x) (dd_add (dwa y) (dwb y))) (dd_mul (dwa x) (dd_add (dlow y) (dhigh y))).

(* C src/metric/measure_filter.c dyd_filter_partial_edge_area2
  hull_axis x, y;
  if (!area2_axis_set(&x, a, b) || !area2_axis_set(&y, a + 2, b + 2)) return false;
  int in_x = x.b_low + x.b_high, in_y = y.b_low + y.b_high;
  if (in_x + in_y > 2) {
    return dyd_filter_partial_edge_area2(out, b, a);
  }
  dd sum;
  if (in_x + in_y == 0) {
    sum = dd_mul(x.wa, y.wa);
    sum = dd_add(sum, sum);
  } else if (in_x == 1 && in_y == 1) {
    sum = area2_corner(&x, &y);
  } else if (in_x + in_y == 1) {
    sum = in_x ? area2_one(&x, &y) : area2_one(&y, &x);
  } else {
    sum = in_x ? area2_cross(&x, &y) : area2_cross(&y, &x);
  }
  dd_inflate(out, sum);
  return true;
*)
Definition dsides (x : daxis) : nat := (Nat.b2n (db_low x) + Nat.b2n (db_high x))%nat.
Definition sum_of (x y : daxis) : dd :=
  if (dsides x + dsides y =? 0)%nat then let s := dd_mul (dwa x) (dwa y) in dd_add s s
  else if ((dsides x =? 1) && (dsides y =? 1))%nat%bool then corner x y
  else if (dsides x + dsides y =? 1)%nat then (if (dsides x =? 0)%nat then one y x else one x y)
  else (if (dsides x =? 0)%nat then cross y x else cross x y).
(* Calls itself at most `calls` times. *)
Fixpoint filter_hull_area2 (calls : nat) (a b : bbox) : option dd :=
  let x := axis_made (e0 a) (e1 a) (e0 b) (e1 b) in
  let y := axis_made (e2 a) (e3 a) (e2 b) (e3 b) in
  if (axis_fine x && axis_fine y)%bool then
    if (2 <? dsides x + dsides y)%nat then match calls with O => None | S more => filter_hull_area2 more b a end
    else Some (inflate (sum_of x y))
  else None.

(** ** Meaning *)

Definition good (k : R) (e : Z) (m : Z) (x : dd) (v : R) : Prop := near k x v /\ ranged m e v.

Lemma equal_zero x : equal x (lit c_zero) = true -> finite x -> val x = 0.
Proof.
  intros H F. destruct (lit_correct c_zero eq_refl) as [F0 V0]. unfold equal, b64_compare in H.
  rewrite Bcompare_correct in H by assumption. revert H. case Rcompare_spec; try discriminate. intros E _.
  rewrite E, V0. unfold cval, c_zero. simpl. ring.
Qed.

Lemma lead_range x v : lead_in_range x = true -> near 0 x v -> good 4 402 (-401) x v.
Proof.
  intros H N. split; [apply (near_weaken 0); [exact N|lra]|].
  destruct N as (F & _ & P & N & L). rewrite !Rmult_0_l in N. apply Rabs_le_inv in N.
  pose proof (Rabs_pos (val (snd x))). apply Rabs_le_inv in L. unfold lead_in_range in H. apply orb_prop in H.
  destruct H as [H|H].
  - left. apply equal_zero in H; [|exact F]. rewrite H in *. unfold u in *. lra.
  - right. apply andb_prop in H. destruct H as [H1 H2].
    destruct (lit_correct c_lead_least eq_refl) as [F1 V1]. destruct (lit_correct c_lead_most eq_refl) as [F2 V2].
    apply (le_finite _ _ F1 F) in H1. apply (le_finite _ _ F F2) in H2. rewrite V1 in H1. rewrite V2 in H2.
    unfold cval, c_lead_least, c_lead_most, fst, snd in H1, H2. rewrite Rmult_1_l in H1, H2. change (-400)%Z with (1 + -401)%Z in H1.
    change 402%Z with (2 + 400)%Z. rewrite bpow_plus in *. change (bpow radix2 1) with 2 in *.
    change (bpow radix2 2) with 4. destruct x as [h l]. cbn [fst snd] in *. unfold u in *. lra.
Qed.

Lemma lead_values x : lead_in_range x = true -> finite (fst x) /\ Rabs (val (fst x)) <= bpow radix2 401.
Proof.
  intros H. destruct (lit_correct c_zero eq_refl) as [F0 _].
  destruct (lit_correct c_lead_least eq_refl) as [F1 V1]. destruct (lit_correct c_lead_most eq_refl) as [F2 V2].
  assert (F : finite (fst x)).
  { destruct x as [[s|[|]|s p Hp|s m e Hm] l]; try reflexivity; exfalso; revert H; unfold lead_in_range; cbn [fst]; clear - F0 F1 F2;
      destruct (lit c_zero); try discriminate F0; destruct (lit c_lead_least); try discriminate F1;
      destruct (lit c_lead_most); try discriminate F2; discriminate. }
  split; [exact F|]. unfold lead_in_range in H. apply orb_prop in H. destruct H as [H|H].
  - apply equal_zero in H; [|exact F]. rewrite H, Rabs_R0. apply bpow_ge_0.
  - apply andb_prop in H. destruct H as [H1 H2].
    apply (le_finite _ _ F1 F) in H1. apply (le_finite _ _ F F2) in H2. rewrite V1 in H1. rewrite V2 in H2.
    destruct x as [h l]. unfold cval, c_lead_least, c_lead_most in H1, H2. cbn [fst snd] in *. rewrite Rmult_1_l in H1, H2. pose proof (bpow_ge_0 radix2 (-400)).
    rewrite Rabs_pos_eq by lra. apply Rle_trans with (1 := H2). apply bpow_le. lia.
Qed.

Lemma lead_diff a b : finite a -> finite b -> val b <= val a -> lead_in_range (dd_sub_d a b) = true ->
  good 4 402 (-401) (dd_sub_d a b) (val a - val b).
Proof.
  intros A B L H. destruct (lead_values _ H) as [F V]. apply lead_range; [exact H|]. now apply near_diff_any.
Qed.

Definition like (d : daxis) (x : axis) : Prop :=
  good 4 402 (-401) (dwa d) (wa x) /\ good 4 402 (-401) (dwb d) (wb x) /\ good 4 402 (-401) (dlow d) (low x) /\
  good 4 402 (-401) (dhigh d) (high x) /\ db_low d = b_low x /\ db_high d = b_high x.

Lemma axis_like a0 a1 b0 b1 : finite a0 -> finite a1 -> finite b0 -> finite b1 -> val a0 <= val a1 ->
  val b0 <= val b1 -> axis_fine (axis_made a0 a1 b0 b1) = true ->
  like (axis_made a0 a1 b0 b1) (axis_of (val a0) (val a1) (val b0) (val b1)).
Proof.
  intros A0 A1 B0 B1 A B F. unfold axis_fine in F. apply andb_prop in F. destruct F as [F Fh].
  apply andb_prop in F. destruct F as [F Fl]. apply andb_prop in F. destruct F as [Fa Fb].
  assert (L : lt b0 a0 = below (val b0) (val a0)).
  { unfold below. pose proof (lt_finite b0 a0 B0 A0) as I. destruct (lt b0 a0), (Rlt_dec (val b0) (val a0)) as [R|R];
      try reflexivity; [exfalso; now apply R, I|]. apply I in R. discriminate. }
  assert (G : gt b1 a1 = below (val a1) (val b1)).
  { unfold below. pose proof (gt_finite b1 a1 B1 A1) as I. destruct (gt b1 a1), (Rlt_dec (val a1) (val b1)) as [R|R];
      try reflexivity; [exfalso; now apply R, I|]. apply I in R. discriminate. }
  unfold axis_made, axis_of, like in *. cbn [dwa dwb dlow dhigh db_low db_high wa wb low high b_low b_high] in *.
  rewrite L, G in *. unfold below in *. destruct (Rlt_dec (val b0) (val a0)) as [X|X]; destruct (Rlt_dec (val a1) (val b1)) as [Y|Y];
    do 4 (split; [apply lead_diff; try assumption; lra|]); split; reflexivity.
Qed.

Lemma good_sum x v y w : good 4 402 (-401) x v -> good 4 402 (-401) y w -> good 8 403 (-401) (dd_add x y) (v + w).
Proof.
  intros [X V] [Y W]. split; [|apply (ranged_add _ 402); assumption].
  replace 8 with (4 + 4) by ring. apply near_add; try assumption; try lra;
    (eapply Rle_trans; [eapply ranged_top; eassumption|apply bpow_le; lia]).
Qed.

Lemma good_more x v : good 4 402 (-401) x v -> good 8 403 (-401) x v.
Proof. intros [X V]. split; [apply (near_weaken 4); [exact X|lra]|apply (ranged_weaken _ _ _ _ _ V); lia]. Qed.

Lemma good_mul x v y w : good 8 403 (-401) x v -> good 8 403 (-401) y w -> good 29 806 (-802) (dd_mul x y) (v * w).
Proof.
  intros [X V] [Y W]. split; [|apply (ranged_mul (-401) 403 (-401) 403); assumption].
  replace 29 with (2 * 8 + 13) by ring. apply near_mul; try assumption; try lra;
    eapply ranged_weaken; try eassumption; lia.
Qed.

Lemma good_add k e x v y w : good k e (-802) x v -> good k e (-802) y w -> 0 <= k <= 100 -> (e <= 810)%Z ->
  good (k + 4) (e + 1) (-802) (dd_add x y) (v + w).
Proof.
  intros [X V] [Y W] K E. split; [|now apply ranged_add].
  apply near_add; try assumption; try lra; (eapply Rle_trans; [eapply ranged_top; eassumption|apply bpow_le; lia]).
Qed.

Lemma good_wider k e k' e' x v : good k e (-802) x v -> k <= k' -> (e <= e')%Z -> good k' e' (-802) x v.
Proof. intros [X V] K E. split; [now apply (near_weaken k)|apply (ranged_weaken _ _ _ _ _ V); lia]. Qed.

Lemma sum_like dx dy x y : like dx x -> like dy y -> good 37 808 (-802) (sum_of dx dy) (area2_form x y).
Proof.
  assert (One : forall dx dy x y, like dx x -> like dy y -> good 37 808 (-802) (one dx dy) (area2_one x y)).
  { clear. intros dx dy x y (A & B & C & D & E & F) (A' & B' & C' & D' & E' & F'). unfold one, area2_one. cbv zeta. rewrite E.
    assert (P : good 8 403 (-401) (if b_low x then dlow dx else dhigh dx) (if b_low x then low x else high x))
      by (destruct (b_low x); now apply good_more).
    pose proof (good_mul _ _ _ _ (good_more _ _ A) (good_more _ _ A')) as M1.
    pose proof (good_mul _ _ _ _ P (good_sum _ _ _ _ A' B')) as M2.
    replace 37 with (29 + 4 + 4) by ring. apply (good_add _ 807); try lra; try lia.
    - apply (good_add _ 806); try assumption; try lra; lia.
    - apply (good_wider _ _ _ _ _ _ M2); [lra|lia]. }
  assert (Cross : forall dx dy x y, like dx x -> like dy y -> good 37 808 (-802) (cross dx dy) (area2_cross x y)).
  { clear. intros dx dy x y (A & B & C & D & E & F) (A' & B' & C' & D' & E' & F'). unfold cross, area2_cross.
    apply (good_wider (29 + 4) 807); [|lra|lia]. apply (good_add _ 806); try lra; try lia;
      (apply good_mul; [now apply good_more|now apply good_sum]). }
  intros X Y. pose proof X as (A & B & C & D & E & F). pose proof Y as (A' & B' & C' & D' & E' & F').
  assert (Sx : dsides dx = sides x) by (unfold dsides, sides; now rewrite E, F).
  assert (Sy : dsides dy = sides y) by (unfold dsides, sides; now rewrite E', F').
  unfold sum_of, area2_form. rewrite Sx, Sy. destruct (sides x + sides y =? 0)%nat.
  { cbv zeta. apply (good_wider (29 + 4) 807); [|lra|lia]. apply (good_add _ 806); try lra; try lia;
      (apply good_mul; now apply good_more). }
  destruct ((sides x =? 1) && (sides y =? 1))%nat%bool.
  - unfold corner, area2_corner. cbv zeta. rewrite E, E'.
    assert (P : good 8 403 (-401) (if b_low x then dlow dx else dhigh dx) (if b_low x then low x else high x))
      by (destruct (b_low x); now apply good_more).
    assert (Q : good 8 403 (-401) (if b_low x then dhigh dx else dlow dx) (if b_low x then high x else low x))
      by (destruct (b_low x); now apply good_more).
    assert (T : good 8 403 (-401) (dd_add (dwa dy) (if b_low y then dlow dy else dhigh dy)) (wa y + (if b_low y then low y else high y)))
      by (destruct (b_low y); now apply good_sum).
    replace 37 with (29 + 4 + 4) by ring. apply (good_add _ 807); try lra; try lia;
      (apply (good_add _ 806); try lra; try lia; apply good_mul; first [assumption | now apply good_more]).
  - destruct (sides x + sides y =? 1)%nat; destruct (sides x =? 0)%nat; auto.
Qed.

(** The rectangle of doubles. *)
Definition is_rect (a : bbox) (A : rect) : Prop :=
  finite (e0 a) /\ finite (e1 a) /\ finite (e2 a) /\ finite (e3 a) /\
  val (e0 a) = xlo A /\ val (e1 a) = xhi A /\ val (e2 a) = ylo A /\ val (e3 a) = yhi A.

(* However often it may call itself; by form_fits once is enough. *)
Theorem filter_hull_area2_correct calls a b A B out : is_rect a A -> is_rect b B -> filter_hull_area2 calls a b = Some out ->
  finite (fst out) /\ finite (snd out) /\
  hull_area2 A B <= val (fst out) + val (snd out) <= (1 + bpow radix2 (-86)) * hull_area2 A B.
Proof.
  assert (Once : forall a b A B, is_rect a A -> is_rect b B ->
    let x := axis_made (e0 a) (e1 a) (e0 b) (e1 b) in let y := axis_made (e2 a) (e3 a) (e2 b) (e3 b) in
    (axis_fine x && axis_fine y)%bool = true -> like x (axis_x A B) /\ like y (axis_y A B)).
  { clear. intros a b A B (A0 & A1 & A2 & A3 & Ea0 & Ea1 & Ea2 & Ea3) (B0 & B1 & B2 & B3 & Eb0 & Eb1 & Eb2 & Eb3) x y F.
    apply andb_prop in F. destruct F as [Fx Fy]. unfold axis_x, axis_y.
    rewrite <- Ea0, <- Ea1, <- Ea2, <- Ea3, <- Eb0, <- Eb1, <- Eb2, <- Eb3.
    split; apply axis_like; try assumption; rewrite ?Ea0, ?Ea1, ?Ea2, ?Ea3, ?Eb0, ?Eb1, ?Eb2, ?Eb3;
      first [apply x_ordered | apply y_ordered]. }
  assert (Sides : forall d x, like d x -> dsides d = sides x).
  { intros d x (_ & _ & _ & _ & E & F). unfold dsides, sides. now rewrite E, F. }
  assert (End : forall a b A B, is_rect a A -> is_rect b B ->
    let x := axis_made (e0 a) (e1 a) (e0 b) (e1 b) in let y := axis_made (e2 a) (e3 a) (e2 b) (e3 b) in
    (axis_fine x && axis_fine y)%bool = true -> (dsides x + dsides y <= 2)%nat ->
    finite (fst (inflate (sum_of x y))) /\ finite (snd (inflate (sum_of x y))) /\
    hull_area2 A B <= val (fst (inflate (sum_of x y))) + val (snd (inflate (sum_of x y))) <= (1 + bpow radix2 (-86)) * hull_area2 A B).
  { clear a b A B. intros a b A B Ra Rb x y F S. destruct (Once a b A B Ra Rb F) as [X Y]. fold x in X. fold y in Y.
    rewrite (Sides _ _ X), (Sides _ _ Y) in S. rewrite <- (form_correct A B S).
    destruct (sum_like _ _ _ _ X Y) as [N R]. apply (inflate_above 37); [exact N|lra|].
    apply (ranged_weaken _ _ _ _ _ R); lia. }
  revert a b A B. induction calls as [|calls IH]; intros a b A B Ra Rb H; cbn [filter_hull_area2] in H;
    destruct (axis_fine (axis_made (e0 a) (e1 a) (e0 b) (e1 b)) && axis_fine (axis_made (e2 a) (e3 a) (e2 b) (e3 b)))%bool eqn:F;
    try discriminate;
    destruct (2 <? dsides (axis_made (e0 a) (e1 a) (e0 b) (e1 b)) + dsides (axis_made (e2 a) (e3 a) (e2 b) (e3 b)))%nat eqn:L;
    try discriminate; try (injection H as <-; apply Nat.ltb_ge in L; now apply End).
  rewrite hull_area2_sym. now apply (IH b a B A).
Qed.
