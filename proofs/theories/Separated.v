(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* An endless chain of segments that avoids the cells Pos of two sites, and crosses the segment between two of their
   points an odd number of times: their pair is not possible [CERT-4]. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Path Winding.
Import ListNotations.
Open Scope R_scope.

(* ---- an open chain around a point that moves ---- *)

Fixpoint steps (a : point) (l : list point) : list (point * point) :=
  match l with [] => [] | b :: r => (a, b) :: steps b r end.
Fixpoint finish (a : point) (l : list point) : point := match l with [] => a | b :: r => finish b r end.

Definition passes_all (z : point) (E : list (point * point)) : Z :=
  fold_right (fun e s => (passes z (fst e) (snd e) + s)%Z) 0%Z E.

(* What an end counts: where it is far above, it continues upwards, on the right of z or on its left. *)
Definition weighs (high : bool) (z v : point) : Z := if high then right z v else 0%Z.

Definition around (ha hb : bool) (a : point) (l : list point) (z : point) : Z :=
  (passes_all z (steps a l) - weighs hb z (finish a l) + weighs ha z a)%Z.

(* Never level with the end, or on its proper side. *)
Definition clear_of (high : bool) (v z : point) : Prop :=
  fst v = fst z -> if high then snd z < snd v else snd v < snd z.

Section Moving.
Variable z : R -> point.
Variable move_z : moves z.

Lemma still (v : point) : moves (fun _ => v).
Proof. split; apply continuity_const; intros x y; reflexivity. Qed.

Lemma steps_near t a l : (forall e, In e (steps a l) -> ~ between (z t) (fst e) (snd e)) ->
  near t (fun s => (passes_all (z s) (steps a l) - (above z t (fun _ => finish a l) s - above z t (fun _ => a) s) =
    passes_all (z t) (steps a l) - (above z t (fun _ => finish a l) t - above z t (fun _ => a) t))%Z).
Proof.
  revert a. induction l as [| b l IH]; intros a Off; simpl in *.
  - exists 1. split; [lra |]. intros s _. lia.
  - pose proof (side_steady z t move_z _ _ (still a) (still b) (Off _ (or_introl eq_refl))) as K.
    pose proof (IH b (fun e F => Off e (or_intror F))) as L. generalize (near_and _ _ _ K L). apply near_weaken.
    intros s [X Y]. simpl in X. lia.
Qed.

Lemma end_near t high v : clear_of high v (z t) ->
  near t (fun s => (weighs high (z s) v - above z t (fun _ => v) s = weighs high (z t) v - above z t (fun _ => v) t)%Z).
Proof.
  intros C. unfold above, weighs. destruct (Req_EM_T (fst v) (fst (z t))) as [E | E].
  - specialize (C E). exists 1. split; [lra |]. intros s _.
    destruct (Rlt_dec (snd (z t)) (snd v)), high; try lia; exfalso; lra.
  - destruct high; [| exists 1; split; [lra | intros; lia]].
    pose proof (near_right z t move_z (fun _ => v) (proj1 (still v)) E) as K. revert K. apply near_weaken.
      intros s K. lia.
Qed.

Theorem around_steady ha hb a l :
  (forall t, 0 <= t <= 1 -> clear_of ha a (z t) /\ clear_of hb (finish a l) (z t) /\
    forall e, In e (steps a l) -> ~ between (z t) (fst e) (snd e)) ->
  around ha hb a l (z 1) = around ha hb a l (z 0).
Proof.
  intros H. assert (Near : forall t, 0 <= t <= 1 -> near t (fun s => around ha hb a l (z s) = around ha hb a l (z t))).
  { intros t T. destruct (H t T) as (A & F & Off).
    generalize (near_and _ _ _ (steps_near t a l Off) (near_and _ _ _ (end_near t ha a A) (end_near t hb _ F))).
    apply near_weaken. intros s (X & Y & W). unfold around. lia. }
  apply (open_closed (fun t => around ha hb a l (z t) = around ha hb a l (z 0))); [reflexivity | |];
    intros t T Q; destruct (Near t T) as [e [E0 K]]; exists e; (split; [exact E0 |]); intros s S _; now rewrite (K s S).
Qed.
End Moving.

(* ---- crossings ---- *)

(* Points of the line pq count as left of it. *)
Definition is_left (p q v : point) : bool := if Rle_dec 0 (orient p q v) then true else false.
Definition opposite (x y : R) : bool := if Rlt_dec (x * y) 0 then true else false.
Definition turning (u v : point) : R := fst u * snd v - snd u * fst v.
Definition minus (a b : point) : point := (fst a - fst b, snd a - snd b).

Definition crosses (p q a b : point) : bool :=
  xorb (is_left p q a) (is_left p q b) && opposite (orient a b p) (orient a b q).

(* The same for the ray from g in direction u. *)
Definition ray_crosses (p q g u : point) : bool :=
  let s := turning (minus q p) u in
  (if Req_EM_T s 0 then false else xorb (is_left p q g) (if Rle_dec 0 s then true else false)) &&
  opposite (turning u (minus p g)) (turning u (minus q g)).

Definition crossed (p q : point) (E : list (point * point)) : bool :=
  fold_right (fun e odd => xorb (crosses p q (fst e) (snd e)) odd) false E.

Section Straight.
Variables p q : point.
Variable apart : p <> q.

(* Coordinates in which q is straight above p, and points left of pq on the right. *)
Definition up (v : point) : point :=
  ((fst q - fst p) * snd v - (snd q - snd p) * fst v, (fst q - fst p) * fst v + (snd q - snd p) * snd v).

Lemma up_mix t a b : up (mix t a b) = mix t (up a) (up b).
Proof. unfold up, mix. simpl. f_equal; ring. Qed.

Lemma length_pos : 0 < dist2 p q.
Proof. pose proof (dist_pos p q apart). rewrite <- dist_sq. nra. Qed.

Lemma up_injective a b : up a = up b -> a = b.
Proof.
  intros E. pose proof length_pos as P. unfold dist2 in P. destruct a as [ax ay], b as [bx b_y]. unfold up in E.
    simpl in E.
  injection E as E F. set (dx := fst q - fst p) in *. set (dy := snd q - snd p) in *.
  assert (D : dx * dx + dy * dy <> 0) by (unfold dx, dy; lra).
  pose proof (f_equal (Rmult dx) E). pose proof (f_equal (Rmult dy) E). pose proof (f_equal (Rmult dx) F).
  pose proof (f_equal (Rmult dy) F). f_equal; apply (Rmult_eq_reg_l (dx * dx + dy * dy)); lra.
Qed.

Lemma up_orient a b c : orient (up a) (up b) (up c) = - dist2 p q * orient a b c.
Proof. unfold orient, up, dist2. simpl. ring. Qed.

Lemma up_level : fst (up q) = fst (up p).
Proof. unfold up. simpl. ring. Qed.

Lemma up_side v : orient p q v = fst (up v) - fst (up p).
Proof. unfold up, orient. simpl. ring. Qed.

(* A point in line with two others that are on different sides of it, across the direction of pq, is between them. *)
Lemma between_sides o a b : orient a b o = 0 -> fst (up a) < fst (up o) <= fst (up b) \/ fst (up b) < fst (up o) <=
  fst (up a) ->
  between o a b.
Proof.
  intros Z S. set (A := fst (up a) - fst (up o)). set (C := fst (up b) - fst (up o)).
  assert (X : C * (fst a - fst o) - A * (fst b - fst o) = (fst q - fst p) * orient a b o)
    by (unfold A, C, up, orient; simpl; ring).
  assert (Y : C * (snd a - snd o) - A * (snd b - snd o) = (snd q - snd p) * orient a b o)
    by (unfold A, C, up, orient; simpl; ring).
  rewrite Z in X, Y. rewrite Rmult_0_r in X, Y. assert (S' : A < 0 <= C \/ C < 0 <= A) by (unfold A, C; lra).
  clearbody A C. clear S. assert (D : C - A <> 0) by lra. set (r := - A / (C - A)).
  assert (Q : r * (C - A) = - A) by (unfold r; field; exact D). exists r. split.
  - split; destruct S' as [S | S]; nra.
  - rewrite (surjective_pairing o). unfold mix. f_equal; apply (Rmult_eq_reg_r (C - A)); try exact D.
    + replace (((1 - r) * fst a + r * fst b) * (C - A)) with ((C - A) * fst a + (r * (C - A)) * (fst b - fst a)) by
      ring.
      rewrite Q. lra.
    + replace (((1 - r) * snd a + r * snd b) * (C - A)) with ((C - A) * snd a + (r * (C - A)) * (snd b - snd a)) by
      ring.
      rewrite Q. lra.
Qed.

Lemma left_right v : right (up p) (up v) = if is_left p q v then 1%Z else 0%Z.
Proof.
  unfold right, is_left. rewrite (up_side v).
  destruct (Rle_dec (fst (up p)) (fst (up v))), (Rle_dec 0 (fst (up v) - fst (up p))); try reflexivity; lra.
Qed.

Lemma right_level v : right (up q) (up v) = right (up p) (up v).
Proof. unfold right. now rewrite up_level. Qed.

Lemma passes_cross a b : ~ between p a b -> ~ between q a b ->
  Z.odd (passes (up p) (up a) (up b) - passes (up q) (up a) (up b)) = crosses p q a b.
Proof.
  intros Np Nq. pose proof length_pos as P. unfold passes, crosses. rewrite !right_level, !left_right, !up_orient.
  assert (S : xorb (is_left p q a) (is_left p q b) = true -> orient a b p <> 0 /\ orient a b q <> 0).
  { unfold is_left. rewrite !up_side. intros X. split; intros Z; [apply Np | apply Nq];
    apply (between_sides _ _ _ Z); rewrite ?up_level;
      destruct (Rle_dec 0 (fst (up a) - fst (up p))), (Rle_dec 0 (fst (up b) - fst (up p))); try discriminate; lra. }
  destruct (is_left p q a), (is_left p q b); try reflexivity; destruct (S eq_refl) as [Op Oq]; clear S; simpl xorb;
    simpl andb;
    unfold opposite;
    assert (Sp : 0 < orient a b p \/ orient a b p < 0) by lra; assert (Sq : 0 < orient a b q \/ orient a b q < 0) by
      lra;
    set (op := orient a b p) in *; set (oq := orient a b q) in *; clearbody op oq;
    repeat match goal with |- context [Rlt_dec ?x ?y] => destruct (Rlt_dec x y) end; try reflexivity; exfalso;
    destruct Sp, Sq; nra.
Qed.

Definition lifted (e : point * point) : point * point := (up (fst e), up (snd e)).

Lemma steps_lifted a l : steps (up a) (map up l) = map lifted (steps a l).
Proof. revert a. induction l as [| b l IH]; intros a; [reflexivity |]. simpl. now rewrite IH. Qed.

Lemma finish_lifted a l : finish (up a) (map up l) = up (finish a l).
Proof. revert a. induction l as [| b l IH]; intros a; [reflexivity |]. simpl. apply IH. Qed.

Lemma crossed_odd E : (forall e, In e E -> ~ between p (fst e) (snd e) /\ ~ between q (fst e) (snd e)) ->
  Z.odd (passes_all (up p) (map lifted E) - passes_all (up q) (map lifted E)) = crossed p q E.
Proof.
  induction E as [| e E IH]; intros H; [reflexivity |]. unfold passes_all, crossed in *. simpl.
  destruct (H e (or_introl eq_refl)) as [A C]. rewrite <- IH by (intros f F; apply H; now right).
  rewrite <- (passes_cross _ _ A C), <- Z.odd_add. f_equal. lia.
Qed.

(* ---- rays that are cut off far out ---- *)

Definition out (T : R) (g u : point) : point := (fst g + T * fst u, snd g + T * snd u).

Definition goes_up (u : point) : bool :=
  if Req_EM_T (fst (up u)) 0 then if Rlt_dec 0 (snd (up u)) then true else false else false.

(* The place is at most K away from 0 along both axes. *)
Definition in_range (K : R) (z : point) : Prop := Rabs (fst (up z)) <= K /\ Rabs (snd (up z)) <= K.

Lemma grows a b K : b <> 0 -> exists T0, 0 <= T0 /\ forall T, T0 <= T -> (0 < b -> K < a + T * b) /\ (b < 0 -> a + T *
  b < - K).
Proof.
  intros D. pose proof (Rabs_pos_lt b D) as P. pose proof (Rabs_pos a) as Pa. pose proof (Rabs_pos K) as Pk.
  exists ((Rabs a + Rabs K + 1) / Rabs b). split; [left; apply Rdiv_lt_0_compat; lra |]. intros T L.
  assert (M : Rabs a + Rabs K + 1 <= T * Rabs b).
  { apply (Rmult_le_compat_r (Rabs b)) in L; [| lra]. unfold Rdiv in L. rewrite Rmult_assoc, Rinv_l in L by lra. lra. }
  pose proof (Rle_abs a). pose proof (Rle_abs (- a)) as N. rewrite Rabs_Ropp in N. pose proof (Rle_abs K).
  split; intros S; [rewrite (Rabs_pos_eq b) in M by lra | rewrite (Rabs_left b) in M by lra]; lra.
Qed.

Lemma up_out T g u : up (out T g u) = (fst (up g) + T * fst (up u), snd (up g) + T * snd (up u)).
Proof. unfold up, out. simpl. f_equal; ring. Qed.

Lemma ray_cut K g u : in_range K p -> u <> (0, 0) -> exists T0, 0 <= T0 /\ forall T, T0 < T ->
  (forall z, in_range K z -> clear_of (goes_up u) (up (out T g u)) (up z)) /\
  crosses p q g (out T g u) = ray_crosses p q g u /\ crosses p q (out T g u) g = ray_crosses p q g u.
Proof.
  intros [Kp _] U. assert (Z : forall T, orient g (out T g u) p = T * turning u (minus p g)) by (intros;
    unfold orient, out, turning, minus; simpl; ring).
  assert (Zq : forall T, orient g (out T g u) q = T * turning u (minus q g)) by (intros;
    unfold orient, out, turning, minus; simpl; ring).
  assert (B : forall a b, orient b a p = - orient a b p /\ orient b a q = - orient a b q) by (intros; unfold orient;
    lra).
  assert (Op : forall T, 0 < T -> opposite (orient g (out T g u) p) (orient g (out T g u) q) =
      opposite (turning u (minus p g)) (turning u (minus q g))).
  { intros T P. rewrite Z, Zq. unfold opposite.
    set (x := turning u (minus p g)). set (y := turning u (minus q g)).
    assert (E : T * x * (T * y) = (T * T) * (x * y)) by ring. assert (0 < T * T) by nra.
    destruct (Rlt_dec (T * x * (T * y)) 0), (Rlt_dec (x * y) 0); try reflexivity; exfalso; nra. }
  assert (Sw : forall T, crosses p q (out T g u) g = crosses p q g (out T g u)).
  { intros T. unfold crosses. rewrite xorb_comm. f_equal. destruct (B g (out T g u)) as [-> ->]. unfold opposite.
    rewrite Rmult_opp_opp. reflexivity. }
  assert (Tu : turning (minus q p) u = fst (up u)) by (unfold turning, minus, up; simpl; ring).
  destruct (Req_dec (fst (up u)) 0) as [F | F].
  - assert (V : snd (up u) <> 0).
    { intros V. apply U. apply up_injective. rewrite (surjective_pairing (up u)), F, V. unfold up. simpl. f_equal;
      ring. }
    destruct (grows (snd (up g)) (snd (up u)) K V) as [T0 [P G]]. exists T0. split; [exact P |]. intros T L.
    destruct (G T ltac:(lra)) as [G1 G2]. rewrite Sw. split; [| split].
    + intros z [_ Kz]. unfold clear_of, goes_up. rewrite up_out. cbn [fst snd]. intros _.
      pose proof (Rle_abs (snd (up z))). pose proof (Rle_abs (- snd (up z))) as N. rewrite Rabs_Ropp in N.
      destruct (Req_EM_T (fst (up u)) 0); [| contradiction].
      destruct (Rdichotomy _ _ V) as [S | S]; [specialize (G2 S) | specialize (G1 S)];
        destruct (Rlt_dec 0 (snd (up u))); lra.
    + unfold crosses, ray_crosses. cbv zeta. rewrite Tu. destruct (Req_EM_T (fst (up u)) 0); [| contradiction].
      unfold is_left. rewrite !up_side, up_out. cbn [fst snd]. rewrite F, Rmult_0_r, Rplus_0_r.
      destruct (Rle_dec 0 (fst (up g) - fst (up p))); reflexivity.
    + unfold crosses, ray_crosses. cbv zeta. rewrite Tu. destruct (Req_EM_T (fst (up u)) 0); [| contradiction].
      unfold is_left. rewrite !up_side, up_out. cbn [fst snd]. rewrite F, Rmult_0_r, Rplus_0_r.
      destruct (Rle_dec 0 (fst (up g) - fst (up p))); reflexivity.
  - destruct (grows (fst (up g)) (fst (up u)) K F) as [T0 [P G]]. exists T0. split; [exact P |]. intros T L.
    destruct (G T ltac:(lra)) as [G1 G2].
    assert (C : crosses p q g (out T g u) = ray_crosses p q g u).
    { unfold crosses, ray_crosses. cbv zeta. rewrite Op by lra. f_equal. rewrite Tu.
      destruct (Req_EM_T (fst (up u)) 0); [contradiction |]. f_equal. unfold is_left. rewrite up_side, up_out.
        cbn [fst snd].
      pose proof (Rle_abs (fst (up p))). pose proof (Rle_abs (- fst (up p))) as N. rewrite Rabs_Ropp in N.
      destruct (Rle_dec 0 (fst (up g) + T * fst (up u) - fst (up p))), (Rle_dec 0 (fst (up u))); try reflexivity;
        exfalso;
        destruct (Rdichotomy _ _ F) as [S | S]; try (specialize (G2 S)); try (specialize (G1 S)); lra. }
    rewrite Sw. split; [| split; exact C].
    intros z [Kz _] E. exfalso. rewrite up_out in E. cbn [fst snd] in E.
    pose proof (Rle_abs (fst (up z))). pose proof (Rle_abs (- fst (up z))) as N. rewrite Rabs_Ropp in N.
    destruct (Rdichotomy _ _ F) as [S | S]; [specialize (G2 S) | specialize (G1 S)]; lra.
Qed.
End Straight.
