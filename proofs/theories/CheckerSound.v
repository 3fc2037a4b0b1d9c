(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker accepts, every legal pair of the certificate has a witness, so it is a strictly Delaunay edge of every
   choice of points in the rectangles. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Checker.
Import ListNotations.
Open Scope R_scope.

(* The number that is written. *)
Definition value (n : number) : R := IZR (man n) * powerRZ 2 (expo n) / IZR (den n).

(* B gives the rectangles of the list: site k of B is the k-th of the list. *)
Definition describes (l : list site) (B : sites) : Prop :=
  forall k s, nth_error l k = Some s ->
    xlo (B k) = value (left s) /\ xhi (B k) = value (right s) /\ ylo (B k) = value (low s) /\ yhi (B k) = value (high s).

(* Site a of the list has this number in the certificate. *)
Definition named (l : list site) (a : nat) (i : Z) : Prop := exists s, nth_error l a = Some s /\ name s = i.

(* ---- units ---- *)

Definition unit (D E : Z) : R := IZR D * powerRZ 2 E.

Lemma unit_pos D E : (0 < D)%Z -> 0 < unit D E.
Proof. intros H. apply Rmult_lt_0_compat; [now apply IZR_lt | apply powerRZ_lt; lra]. Qed.

Lemma shift_value z n : (0 <= n)%Z -> IZR (Z.shiftl z n) = IZR z * powerRZ 2 n.
Proof.
  intros H. rewrite Z.shiftl_mul_pow2 by exact H. rewrite mult_IZR. f_equal.
  rewrite <- (Z2Nat.id n) by exact H. rewrite <- pow_IZR, <- pow_powerRZ. reflexivity.
Qed.

Lemma scaled_value D E n z : scaled D E n = Some z -> IZR z = value n * unit D E.
Proof.
  unfold scaled. destruct (0 <? den n)%Z eqn:P; [| discriminate]. destruct (0 <=? expo n + E)%Z eqn:Q; [| discriminate].
  destruct (D mod den n =? 0)%Z eqn:M; [| discriminate]. simpl. intros H. injection H as <-.
  apply Z.ltb_lt in P. apply Z.leb_le in Q. apply Z.eqb_eq in M.
  rewrite shift_value by exact Q. rewrite mult_IZR, powerRZ_add by lra. unfold value, unit.
  assert (N : IZR (den n) <> 0) by (apply not_0_IZR; lia).
  assert (F : IZR D = IZR (den n) * IZR (D / den n)).
  { rewrite <- mult_IZR. f_equal. pose proof (Z.div_mod D (den n)). lia. }
  rewrite F. field. exact N.
Qed.

(* ---- one axis ---- *)

Lemma unscale_lt S a b za zb : 0 < S -> IZR za = a * S -> IZR zb = b * S -> (za < zb)%Z -> a < b.
Proof. intros P A B H. apply IZR_lt in H. rewrite A, B in H. now apply Rmult_lt_reg_r in H. Qed.

Lemma unscale_le S a b za zb : 0 < S -> IZR za = a * S -> IZR zb = b * S -> (za <= zb)%Z -> a <= b.
Proof. intros P A B H. apply IZR_le in H. rewrite A, B in H. now apply Rmult_le_reg_r in H. Qed.

Lemma gap_value S lo hi t zl zh zt : 0 < S -> lo <= hi -> IZR zl = lo * S -> IZR zh = hi * S -> IZR zt = t * S ->
  IZR (gap zl zh zt * gap zl zh zt) = S * S * ((t - clamp lo hi t) * (t - clamp lo hi t)).
Proof.
  intros P O L H T. rewrite mult_IZR. unfold gap, clamp, Rmax, Rmin.
  destruct (Z.ltb_spec zt zl) as [A | A]; [| destruct (Z.ltb_spec zh zt) as [B | B]].
  - pose proof (unscale_lt S _ _ _ _ P T L A). rewrite minus_IZR, L, T.
    destruct (Rle_dec hi t); destruct (Rle_dec lo _); try lra; nra.
  - pose proof (unscale_lt S _ _ _ _ P H T B). rewrite minus_IZR, H, T.
    destruct (Rle_dec hi t); destruct (Rle_dec lo _); try lra; nra.
  - pose proof (unscale_le S _ _ _ _ P L T A). pose proof (unscale_le S _ _ _ _ P T H B).
    destruct (Rle_dec hi t); destruct (Rle_dec lo _); try lra.
    replace t with hi by lra. lra.
Qed.

Lemma reach_value S lo hi t zl zh zt : 0 < S -> IZR zl = lo * S -> IZR zh = hi * S -> IZR zt = t * S ->
  IZR (reach zl zh zt * reach zl zh zt) = S * S * ((t - far_end lo hi t) * (t - far_end lo hi t)).
Proof.
  intros P L H T. rewrite mult_IZR. unfold reach, far_end.
  assert (A : IZR (zt - zl) = (t - lo) * S) by (rewrite minus_IZR, L, T; ring).
  assert (B : IZR (zh - zt) = (hi - t) * S) by (rewrite minus_IZR, H, T; ring).
  destruct (Z.max_spec (zt - zl) (zh - zt)) as [[C ->] | [C ->]].
  - pose proof (unscale_lt S _ _ _ _ P A B C). destruct (Rle_dec (hi - t) (t - lo)); [lra |]. rewrite B. ring.
  - pose proof (unscale_le S _ _ _ _ P B A C). destruct (Rle_dec (hi - t) (t - lo)); [| lra]. rewrite A. ring.
Qed.

(* ---- boxes ---- *)

(* b is the rectangle R in units of 1 / S. *)
Definition is_box (S : R) (b : box) (R0 : rect) : Prop :=
  IZR (x0 b) = xlo R0 * S /\ IZR (x1 b) = xhi R0 * S /\ IZR (y0 b) = ylo R0 * S /\ IZR (y1 b) = yhi R0 * S.

Lemma ds2_value S b R0 x y c : 0 < S -> is_box S b R0 -> IZR x = fst c * S -> IZR y = snd c * S ->
  IZR (ds2 x y b) = S * S * (ds c R0 * ds c R0).
Proof.
  intros P (A & B & C & D) X Y. unfold ds2. rewrite plus_IZR.
  rewrite (gap_value S (xlo R0) (xhi R0) (fst c)) by (assumption || apply x_ordered).
  rewrite (gap_value S (ylo R0) (yhi R0) (snd c)) by (assumption || apply y_ordered).
  unfold ds. rewrite dist_sq. unfold dist2, nearest. simpl. ring.
Qed.

Lemma dl2_value S b R0 x y c : 0 < S -> is_box S b R0 -> IZR x = fst c * S -> IZR y = snd c * S ->
  IZR (dl2 x y b) = S * S * (dl c R0 * dl c R0).
Proof.
  intros P (A & B & C & D) X Y. unfold dl2. rewrite plus_IZR.
  rewrite (reach_value S (xlo R0) (xhi R0) (fst c)) by assumption.
  rewrite (reach_value S (ylo R0) (yhi R0) (snd c)) by assumption.
  unfold dl. rewrite dist_sq. unfold dist2, farthest. simpl. ring.
Qed.

(* A box that covers another one is not farther away. *)
Lemma gap_covers lo hi l h t : (lo <= l)%Z -> (l <= h)%Z -> (h <= hi)%Z -> (0 <= gap lo hi t <= gap l h t)%Z.
Proof.
  intros L O H. unfold gap.
  destruct (Z.ltb_spec t lo); destruct (Z.ltb_spec t l); try destruct (Z.ltb_spec hi t); try destruct (Z.ltb_spec h t); lia.
Qed.

Lemma off_disc_covers x y r2 s h b : covers h b -> ordered b -> off_disc x y r2 s h = true -> off_disc x y r2 s b = true.
Proof.
  intros (X0 & X1 & Y0 & Y1) [Ox Oy]. unfold off_disc. cbv zeta. rewrite !orb_true_iff, !Z.ltb_lt.
  pose proof (gap_covers _ _ _ _ x X0 Ox X1) as U. pose proof (gap_covers _ _ _ _ y Y0 Oy Y1) as V.
  intros [[H | H] | H]; [left; left; lia | left; right; lia | right; nia].
Qed.

Lemma off_disc_sound x y r2 s b : (0 <= s)%Z -> (r2 <= s * s)%Z -> off_disc x y r2 s b = true -> (r2 < ds2 x y b)%Z.
Proof.
  intros S R0. unfold off_disc, ds2. cbv zeta. rewrite !orb_true_iff, !Z.ltb_lt. intros [[H | H] | H]; nia.
Qed.

(* ---- lists ---- *)

Lemma scaled_onto_all D E l before bs : scaled_onto D E l before = Some bs ->
  exists cs, bs = rev_append before cs /\ Forall2 (fun s b => scaled_site D E s = Some b) l cs.
Proof.
  revert before. induction l as [| s l IH]; intros before H; simpl in H.
  - injection H as <-. now exists [].
  - destruct (scaled_site D E s) as [b |] eqn:S; [| discriminate]. destruct (IH (b :: before) H) as (cs & -> & F).
    exists (b :: cs). split; [reflexivity | now constructor].
Qed.

Lemma scaled_sites_all D E l bs : scaled_sites D E l = Some bs -> Forall2 (fun s b => scaled_site D E s = Some b) l bs.
Proof. intros H. destruct (scaled_onto_all D E l [] bs H) as (cs & -> & F). exact F. Qed.

Lemma scaled_sites_nth D E l bs k s : scaled_sites D E l = Some bs -> nth_error l k = Some s ->
  exists b, nth_error bs k = Some b /\ scaled_site D E s = Some b.
Proof.
  intros H. apply scaled_sites_all in H. revert k. induction H as [| t b l bs T H IH]; intros k K; [now destruct k |].
  destruct k as [| k]; simpl in *; [injection K as <-; now exists b | exact (IH k K)].
Qed.

Lemma scaled_sites_length D E l bs : scaled_sites D E l = Some bs -> length bs = length l.
Proof. intros H. apply scaled_sites_all in H. induction H as [| s b l bs S H IH]; simpl; congruence. Qed.

Lemma scaled_site_box D E s b R0 : (0 < D)%Z -> scaled_site D E s = Some b ->
  xlo R0 = value (left s) -> xhi R0 = value (right s) -> ylo R0 = value (low s) -> yhi R0 = value (high s) ->
  is_box (unit D E) b R0 /\ box_name b = name s /\ (x0 b <= x1 b)%Z /\ (y0 b <= y1 b)%Z.
Proof.
  intros P H A B C F. unfold scaled_site in H.
  destruct (scaled D E (left s)) eqn:L; [| discriminate]. destruct (scaled D E (right s)) eqn:R1; [| discriminate].
  destruct (scaled D E (low s)) eqn:W; [| discriminate]. destruct (scaled D E (high s)) eqn:G; [| discriminate].
  destruct (z <=? z0)%Z eqn:O1; [| discriminate]. destruct (z1 <=? z2)%Z eqn:O2; [| discriminate].
  simpl in H. injection H as <-. simpl. apply Z.leb_le in O1, O2. unfold is_box. simpl.
  rewrite A, B, C, F. repeat split; try assumption; now apply scaled_value.
Qed.

Lemma rising_above last bs k b : rising last bs = true -> nth_error bs k = Some b -> (last < box_name b)%Z.
Proof.
  revert last k. induction bs as [| t bs IH]; intros last k H K; [now destruct k |].
  simpl in H. apply andb_true_iff in H. destruct H as [A H]. apply Z.ltb_lt in A.
  destruct k as [| k]; simpl in K; [now injection K as <- |]. pose proof (IH _ k H K). lia.
Qed.

Lemma rising_names last bs k l a b : rising last bs = true -> nth_error bs k = Some a -> nth_error bs l = Some b ->
  box_name a = box_name b -> k = l.
Proof.
  revert last k l. induction bs as [| t bs IH]; intros last k l H K L N; [now destruct k |].
  simpl in H. apply andb_true_iff in H. destruct H as [_ H].
  destruct k as [| k], l as [| l]; simpl in *; [reflexivity | | |].
  - injection K as ->. pose proof (rising_above _ _ _ _ H L). lia.
  - injection L as ->. pose proof (rising_above _ _ _ _ H K). lia.
  - f_equal. exact (IH _ k l H K L N).
Qed.

(* The box of a name. *)
Definition find_box (boxes : list box) (i : Z) : option box := find (fun b => (box_name b =? i)%Z) boxes.

Lemma find_box_nth last bs k i b : rising last bs = true -> nth_error bs k = Some b -> box_name b = i ->
  find_box bs i = Some b.
Proof.
  intros H K N. unfold find_box. destruct (find (fun b => (box_name b =? i)%Z) bs) as [a |] eqn:F.
  - apply find_some in F. destruct F as [I Q]. apply Z.eqb_eq in Q. apply In_nth_error in I. destruct I as [l L].
    assert (k = l) by (apply (rising_names last bs k l b a); congruence). congruence.
  - apply nth_error_In in K. pose proof (find_none _ _ F b K) as Q. simpl in Q. apply Z.eqb_neq in Q. congruence.
Qed.

Lemma found_box_is last bs i b : rising last bs = true -> Map.find i (index box_name bs) = Some b -> find_box bs i = Some b.
Proof.
  intros H F. apply index_in in F. destruct F as [I N]. apply In_nth_error in I. destruct I as [k K].
  exact (find_box_nth last bs k i b H K N).
Qed.

(* ---- soundness ---- *)

Section Accepted.
Variables (D E : Z) (l : list site) (edges : list edge) (B : sites).
Variable accepted : check D E l edges = true.
Variable described : describes l B.

Lemma accepted_parts : exists bs, scaled_sites D E l = Some bs /\ (0 < D)%Z /\ rising (-1) bs = true /\
  forall e, In e edges -> check_edge D E (index box_name bs) (build deepest bs) e = true.
Proof.
  unfold check in accepted. destruct (scaled_sites D E l) as [bs |]; [| discriminate]. exists bs.
  apply andb_true_iff in accepted. destruct accepted as [A F]. apply andb_true_iff in A. destruct A as [P R0].
  rewrite forallb_forall in F. now apply Z.ltb_lt in P.
Qed.

Lemma box_of k : (k < length l)%nat -> forall bs, scaled_sites D E l = Some bs -> (0 < D)%Z ->
  exists s b, nth_error l k = Some s /\ nth_error bs k = Some b /\ box_name b = name s /\ is_box (unit D E) b (B k) /\
    (x0 b <= x1 b)%Z /\ (y0 b <= y1 b)%Z.
Proof.
  intros K bs H P. destruct (nth_error l k) as [s |] eqn:S; [| apply nth_error_None in S; lia].
  destruct (scaled_sites_nth D E l bs k s H S) as [b [N C]]. destruct (described k s S) as (X0 & X1 & Y0 & Y1).
  destruct (scaled_site_box D E s b (B k) P C X0 X1 Y0 Y1) as (I & M & O). exists s, b. tauto.
Qed.

(* The point written beside a pair is a witness of the pair. *)
Theorem accepted_witness e a b : In e edges -> named l a (from e) -> named l b (to e) ->
  witness (length l) B a b (value (at_x e), value (at_y e)).
Proof.
  intros I [sa [Na Fa]] [sb [Nb Fb]] k K Da Db.
  destruct accepted_parts as (bs & H & P & R0 & C). specialize (C e I). pose proof (unit_pos D E P) as U.
  unfold check_edge in C. destruct (scaled D E (at_x e)) as [x |] eqn:X; [| discriminate].
  destruct (scaled D E (at_y e)) as [y |] eqn:Y; [| discriminate].
  apply scaled_value in X, Y. set (c := (value (at_x e), value (at_y e))).
  destruct (box_of a) with (bs := bs) as (sa' & ba & A1 & A2 & A3 & A4 & _); [| assumption | assumption |].
  { apply nth_error_Some. congruence. }
  destruct (box_of b) with (bs := bs) as (sb' & bb & B1 & B2 & B3 & B4 & _); [| assumption | assumption |].
  { apply nth_error_Some. congruence. }
  destruct (box_of k K bs H P) as (sk & bk & K1 & K2 & K3 & K4 & Ox & Oy).
  assert (sa' = sa) by congruence. assert (sb' = sb) by congruence. subst sa' sb'.
  unfold check_witness in C.
  destruct (Map.find (from e) _) as [ma |] eqn:Ma; [| discriminate]. destruct (Map.find (to e) _) as [mb |] eqn:Mb; [| discriminate].
  apply (found_box_is (-1)) in Ma, Mb; try assumption.
  rewrite (find_box_nth (-1) bs a (from e) ba R0 A2) in Ma by congruence. injection Ma as <-.
  rewrite (find_box_nth (-1) bs b (to e) bb R0 B2) in Mb by congruence. injection Mb as <-. cbv zeta in C.
  apply andb_true_iff in C. destruct C as [S0 C]. apply andb_true_iff in S0. destruct S0 as [S0 S1]. apply Z.leb_le in S0, S1.
  apply all_in_each with (b := bk) in C; [| | now split | exact (nth_error_In _ _ K2)].
  2: { intros h k0 Ch Ok H0. now rewrite (off_disc_covers x y _ _ h k0 Ch Ok H0). }
  rewrite !orb_true_iff, !Z.eqb_eq in C.
  assert (G : (Z.max (dl2 x y ba) (dl2 x y bb) < ds2 x y bk)%Z).
  { destruct C as [[C | C] | C].
    - now apply off_disc_sound in C.
    - exfalso. apply Da. apply (rising_names (-1) bs k a bk ba R0 K2 A2). congruence.
    - exfalso. apply Db. apply (rising_names (-1) bs k b bk bb R0 K2 B2). congruence. }
  assert (G1 : (dl2 x y ba < ds2 x y bk)%Z) by lia. assert (G2 : (dl2 x y bb < ds2 x y bk)%Z) by lia.
  apply IZR_lt in G1, G2.
  rewrite (dl2_value (unit D E) ba (B a) x y c U A4 X Y), (ds2_value (unit D E) bk (B k) x y c U K4 X Y) in G1.
  rewrite (dl2_value (unit D E) bb (B b) x y c U B4 X Y), (ds2_value (unit D E) bk (B k) x y c U K4 X Y) in G2.
  pose proof (dl_nonneg c (B a)). pose proof (dl_nonneg c (B b)). pose proof (ds_nonneg c (B k)).
  assert (V : 0 < unit D E * unit D E) by now apply Rmult_lt_0_compat.
  apply Rmult_lt_reg_l in G1; [| exact V]. apply Rmult_lt_reg_l in G2; [| exact V]. split; nra.
Qed.

(* Every pair is a strictly Delaunay edge, whatever the points in the rectangles are. *)
Theorem accepted_edges e a b p : In e edges -> named l a (from e) -> named l b (to e) ->
  choice (length l) B p -> strict_edge (length l) p a b.
Proof.
  intros I A C P. assert (La : (a < length l)%nat) by (destruct A as [s [A _]]; apply nth_error_Some; congruence).
  assert (Lb : (b < length l)%nat) by (destruct C as [s [C _]]; apply nth_error_Some; congruence).
  apply (legal_sound (length l) B a b p La Lb); [| exact P].
  exists (value (at_x e), value (at_y e)). now apply accepted_witness.
Qed.

(* The sites of a pair are there. *)
Theorem accepted_names e : In e edges -> (exists a, named l a (from e)) /\ (exists b, named l b (to e)).
Proof.
  intros I. destruct accepted_parts as (bs & H & P & R0 & C). specialize (C e I). unfold check_edge in C.
  destruct (scaled D E (at_x e)); [| discriminate]. destruct (scaled D E (at_y e)); [| discriminate].
  unfold check_witness in C. destruct (Map.find (from e) _) as [ba |] eqn:A; [| discriminate].
  destruct (Map.find (to e) _) as [bb |] eqn:F; [| discriminate]. apply (found_box_is (-1)) in A, F; try assumption.
  assert (G : forall i b, find_box bs i = Some b -> exists a, named l a i).
  { intros i b0 Q. apply find_some in Q. destruct Q as [Q N]. apply Z.eqb_eq in N. apply In_nth_error in Q.
    destruct Q as [k K]. assert (L : (k < length l)%nat).
    { rewrite <- (scaled_sites_length D E l bs H). apply nth_error_Some. congruence. }
    destruct (box_of k L bs H P) as (s & b1 & S & T & M & _). exists k, s. split; [exact S | congruence]. }
  split; eapply G; eassumption.
Qed.

End Accepted.
